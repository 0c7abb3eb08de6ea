// Compares the highlighting of the page with that of vscode-textmate, which uses the same grammar, for the given scripts.
// esbuild bundles this file with the sources of the page: see .ci/run.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { StringStream } from "@codemirror/language";
import oniguruma from "vscode-oniguruma";
import textmate from "vscode-textmate";
import grammar from "../../docs/editors/vscode/withy.tmLanguage.json";
import { parser, styleOf } from "../../docs/playground/source/grammar.js";

const engine = createRequire(import.meta.url).resolve("vscode-oniguruma").replace(/main\.js$/, "onig.wasm");
await oniguruma.loadWASM(readFileSync(engine).buffer);
const onigLib = Promise.resolve({
  createOnigScanner: (sources) => new oniguruma.OnigScanner(sources),
  createOnigString: (text) => new oniguruma.OnigString(text),
});
const registry = new textmate.Registry({ onigLib, loadGrammar: async () => grammar });
const reference = await registry.loadGrammar("source.rhai");

/** Style of each character from the scopes of vscode-textmate. Code in `${}` does not have the style of its string. */
function expected(line, tokens) {
  const styles = Array(line.length).fill(null);
  for (const { startIndex, endIndex, scopes } of tokens) {
    const scope = scopes.findLast((scope) => styleOf(scope) || scope.startsWith("meta.embedded"));
    styles.fill(styleOf(scope), startIndex, endIndex);
  }
  return styles.slice(0, line.length);
}

function ours(line, state) {
  const styles = [];
  if (line === "") parser.blankLine(state);
  const stream = new StringStream(line, 4, 4);
  while (!stream.eol()) {
    const start = stream.pos;
    const style = parser.token(stream, state);
    assert.ok(stream.pos > start, `no progress in ${line}`);
    while (styles.length < stream.pos) styles.push(style);
  }
  return styles;
}

let lines = 0;
for (const file of process.argv.slice(2)) {
  let rules = textmate.INITIAL;
  const state = parser.startState();
  for (const [index, line] of readFileSync(file, "utf8").split("\n").entries()) {
    const { tokens, ruleStack } = reference.tokenizeLine(line, rules);
    rules = ruleStack;
    assert.deepEqual(ours(line, state), expected(line, tokens), `${file}:${index + 1}: ${line}`);
    lines += 1;
  }
}
assert.ok(lines > 10_000, `only ${lines} lines`);
console.log(`ok: ${lines} lines are highlighted as in editors`);
