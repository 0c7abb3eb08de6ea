// Highlighting with the TextMate grammar of the editors, as a CodeMirror language.
import { StreamLanguage } from "@codemirror/language";
import grammar from "../../editors/vscode/withy.tmLanguage.json";

/** Styles of CodeMirror for scopes. The first entry that begins the scope counts. */
const STYLES = [
  ["comment", "comment"],
  ["string", "string"],
  ["constant.character.escape", "escape"],
  ["constant.numeric", "number"],
  ["constant.language", "bool"],
  ["variable.language", "self"],
  ["keyword", "keyword"],
  ["support.function", "variableName.standard"],
  ["support.constant", "atom"],
  ["entity.name.function.member", "propertyName.function"],
  ["entity.name.function.module", "variableName.function"],
  ["variable.other.member", "propertyName"],
];

export const styleOf = (scope) => STYLES.find(([start]) => scope?.startsWith(start))?.[1] ?? null;
const expression = (source) => new RegExp(source, "gu");

/** Compiles a pattern of the grammar. A rule has `match`, or `begin` and `end`; a group of rules has neither. */
function compile(pattern) {
  return {
    match: pattern.match && expression(pattern.match),
    begin: pattern.begin && expression(pattern.begin),
    end: pattern.end,
    style: styleOf(pattern.name),
    captures: Object.entries(pattern.captures ?? {}).map(([group, { name }]) => [Number(group), styleOf(name)]),
    patterns: pattern.patterns ?? [],
  };
}

const compiled = new Map();

/** Rules of a list of patterns, with includes and groups replaced by their rules. */
function rules(patterns) {
  if (!compiled.has(patterns)) {
    const expand = (pattern) => {
      if (pattern.include === "$self") return rules(grammar.patterns);
      if (pattern.include) return expand(grammar.repository[pattern.include.slice(1)]);
      return pattern.match || pattern.begin ? [compile(pattern)] : rules(pattern.patterns);
    };
    compiled.set(patterns, []); // a group may contain itself
    compiled.set(patterns, patterns.flatMap(expand));
  }
  return compiled.get(patterns);
}

const escaped = (text) => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");

function find(regex, line, from) {
  regex.lastIndex = from;
  return regex.exec(line);
}

/** First match in a line at or after a position: the end of the innermost rule, or one of the rules inside it. */
function next(line, from, { end, patterns }) {
  let best = end && find(end, line, from);
  let rule = null;
  for (const candidate of rules(patterns)) {
    const found = find(candidate.match ?? candidate.begin, line, from);
    if (found && (!best || found.index < best.index)) [best, rule] = [found, candidate];
  }
  return best && { found: best, rule };
}

/** Pieces of a match with different styles. */
function pieces(found, rule) {
  const list = [];
  let at = found.index;
  for (const [group, style] of rule.captures) {
    const start = found.index + found[0].indexOf(found[group]);
    list.push({ end: start, style: rule.style }, { end: start + found[group].length, style });
    at = start + found[group].length;
  }
  list.push({ end: found.index + found[0].length, style: rule.style });
  return list.filter(({ end }, index) => end > (list[index - 1]?.end ?? found.index) || end > at);
}

const outermost = { end: null, patterns: grammar.patterns, style: null };
const innermost = (state) => state.open.at(-1) ?? outermost;

/** Closes rules that end with their line, such as strings without a closing quotation mark. */
function closeAtLineEnd(line, state) {
  for (let found; state.open.length > 0; state.open.pop()) {
    const { end } = innermost(state);
    found = end && find(end, line, line.length);
    if (!found) break;
  }
}

export const parser = {
  name: "withy",
  startState: () => ({ open: [], pieces: [] }),
  copyState: (state) => ({ open: [...state.open], pieces: [...state.pieces] }),
  blankLine: (state) => closeAtLineEnd("", state),
  token(stream, state) {
    const line = stream.string;
    const piece = state.pieces.shift();
    if (piece) {
      stream.pos = piece.end;
      if (stream.eol() && state.pieces.length === 0) closeAtLineEnd(line, state);
      return piece.style;
    }
    const current = innermost(state);
    const match = next(line, stream.pos, current);
    const start = match?.found.index ?? line.length;
    if (start > stream.pos) {
      stream.pos = start;
      if (stream.eol()) closeAtLineEnd(line, state);
      return current.style;
    }
    const { found, rule } = match;
    const style = rule ? rule.style : current.style;
    if (!rule) state.open.pop();
    else if (rule.begin) {
      const end = rule.end.replace(/\\(\d)/g, (_, group) => escaped(found[group]));
      state.open.push({ end: expression(end), patterns: rule.patterns, style: rule.style });
    } else if (rule.captures.length > 0) {
      state.pieces = pieces(found, rule);
      return parser.token(stream, state);
    }
    stream.pos = start + found[0].length;
    if (stream.eol()) closeAtLineEnd(line, state);
    return style;
  },
  languageData: { commentTokens: { line: "//", block: { open: "/*", close: "*/" } }, closeBrackets: { brackets: ["(", "[", "{", '"', "`"] } },
};

export const language = StreamLanguage.define(parser);
