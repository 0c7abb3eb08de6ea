// Colours of files by a TextMate grammar, as editors find them: node textmate.mjs NODE_MODULES GRAMMAR FILE…
// Prints, for each file, a JSON array of [text, colour] that together are the file. tests/program/editors.rs calls it.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [modules, grammarFile, ...files] = process.argv.slice(2);
const require = createRequire(modules + "/");
const textmate = require("vscode-textmate");
const oniguruma = require("vscode-oniguruma");
await oniguruma.loadWASM(readFileSync(modules + "/vscode-oniguruma/release/onig.wasm"));
const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () => textmate.parseRawGrammar(readFileSync(grammarFile, "utf8"), grammarFile),
});
const grammar = await registry.loadGrammar("source.rhai");

const colours = [
  [/^comment/, "comment"],
  [/^meta\.embedded|^entity|^variable\.other/, "plain"],
  [/^string|^constant\.character/, "text"],
  [/^constant\.numeric/, "number"],
  [/^keyword|^constant\.language|^variable\.language/, "keyword"],
  [/^support\.function/, "function"],
  [/^support\.constant/, "constant"],
];

/** That of the innermost scope that has one. */
function colour(scopes) {
  for (const scope of [...scopes].reverse()) {
    for (const [pattern, name] of colours) if (pattern.test(scope)) return name;
  }
  return "plain";
}

for (const file of files) {
  const pieces = [];
  let state = textmate.INITIAL;
  const lines = readFileSync(file, "utf8").split("\n");
  lines.forEach((line, index) => {
    const result = grammar.tokenizeLine(line, state);
    for (const token of result.tokens) {
      const text = line.slice(token.startIndex, token.endIndex);
      if (text) pieces.push([text, colour(token.scopes)]);
    }
    if (index + 1 < lines.length) pieces.push(["\n", "plain"]);
    state = result.ruleStack;
  });
  console.log(JSON.stringify(pieces));
}
