// Editor with highlighting, and with completion and errors from the program.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, isolateHistory } from "@codemirror/commands";
import { bracketMatching, indentOnInput, indentUnit, syntaxHighlighting, syntaxTree } from "@codemirror/language";
import { linter, lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightSpecialChars, hoverTooltip, keymap, lineNumbers } from "@codemirror/view";
import { classHighlighter } from "@lezer/highlight";
import { language } from "./grammar.js";
import { ask, SCRIPT } from "./jobs.js";
import { fromByte, range, toByte } from "./places.js";

const PAUSE = 400; // ms without typing before a check or a hint

const askAt = (text, position) => ask(["complete", SCRIPT, String(toByte(text, position))], text);

async function complete(context) {
  const word = context.matchBefore(/[\p{L}_]\w*/u);
  const isMember = context.matchBefore(/(\.|::)\s*/) !== null;
  if (!word && !isMember && !context.explicit) return null;
  const text = context.state.doc.toString();
  const job = askAt(text, context.pos);
  context.addEventListener("abort", job.stop);
  const found = await job.value;
  if (!found || found.options.length === 0) return null;
  const options = found.options.map(({ label, insert, about }) => {
    return { label: insert, displayLabel: label, info: about || undefined };
  });
  return { from: fromByte(text, found.start), options, validFor: /^\w*$/ };
}

function diagnosticOf(doc, { message, hint, place }) {
  const own = place?.file === SCRIPT ? place : { line: 1, column: 1, length: 0 };
  const where = place && place.file !== SCRIPT ? ` (${place.file}, line ${place.line})` : "";
  return { ...range(doc, own), severity: "error", message: message + where + (hint ? `\n${hint}` : "") };
}

async function check(view) {
  const doc = view.state.doc;
  const found = await ask(["check", SCRIPT], doc.toString()).value;
  return (found ?? []).map((diagnostic) => diagnosticOf(doc, diagnostic));
}

/** Help page of the name at a position. */
async function help(view, position) {
  const kind = syntaxTree(view.state).resolveInner(position, 1).name;
  const word = view.state.wordAt(position);
  if (!word || /comment|string/.test(kind)) return null;
  const page = await ask(["help", view.state.sliceDoc(word.from, word.to)]).value;
  if (!page) return null;
  const create = () => {
    const dom = document.createElement("pre");
    Object.assign(dom, { className: "help", textContent: page });
    return { dom };
  };
  return { pos: word.from, end: word.to, create };
}

/** Extension that passes the hint at the cursor, such as the signature of a call, to `show`. */
function hints(show) {
  let timer;
  let job;
  return EditorView.updateListener.of(({ state, docChanged, selectionSet }) => {
    if (!docChanged && !selectionSet) return;
    clearTimeout(timer);
    job?.stop();
    timer = setTimeout(async () => {
      const text = state.doc.toString();
      job = askAt(text, state.selection.main.head);
      const found = await job.value;
      if (found) show(found.hint ?? "");
    }, PAUSE);
  });
}

/** Creates the editor. `onChange(text)` is called after each change, `onHint(text)` with the hint at the cursor. */
export function createEditor(parent, { text, keys, onChange, onHint }) {
  const extensions = [
    lineNumbers(),
    lintGutter(),
    highlightSpecialChars(),
    history(),
    drawSelection(),
    EditorState.allowMultipleSelections.of(true),
    indentUnit.of("    "),
    indentOnInput(),
    bracketMatching(),
    closeBrackets(),
    highlightActiveLine(),
    highlightSelectionMatches(),
    language,
    syntaxHighlighting(classHighlighter),
    autocompletion({ override: [complete] }),
    linter(check, { delay: PAUSE }),
    hints(onHint),
    hoverTooltip(help),
    EditorView.contentAttributes.of({ "aria-label": "Script", tabindex: "0" }),
    EditorView.updateListener.of(({ docChanged, state }) => docChanged && onChange(state.doc.toString())),
    keymap.of([...keys, ...closeBracketsKeymap, ...completionKeymap, ...lintKeymap, ...searchKeymap, ...historyKeymap, ...defaultKeymap]),
  ];
  const view = new EditorView({ parent, state: EditorState.create({ doc: text, extensions }) });
  // The content has the focus and scrolls with the cursor.
  view.scrollDOM.removeAttribute("tabindex");
  return {
    view,
    text: () => view.state.doc.toString(),
    /** Replaces the whole text. Undo restores the old text. */
    replace: (insert) => {
      const changes = { from: 0, to: view.state.doc.length, insert };
      view.dispatch({ changes, selection: { anchor: 0 }, annotations: isolateHistory.of("full"), scrollIntoView: true });
    },
    /** Marks an error of a run and shows its line. */
    mark: (place, message) => {
      const at = range(view.state.doc, place);
      view.dispatch(setDiagnostics(view.state, [{ ...at, severity: "error", message }]));
      view.dispatch({ effects: EditorView.scrollIntoView(at.from, { y: "center" }) });
    },
  };
}
