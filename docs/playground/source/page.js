// The page: buttons, list of scripts, and runs.
import { createEditor } from "./editor.js";
import { load, SCRIPT, start } from "./jobs.js";
import { earlier, keep, kept, putAway } from "./keep.js";
import { fromLink, toLink } from "./link.js";
import { Output } from "./output.js";

const part = (id) => document.getElementById(id);
const status = (text) => (part("status").textContent = text);
const output = new Output({ printed: part("printed"), pictures: part("pictures"), files: part("files") });
const LONGEST_LINK = 30_000; // characters; longer links are cut off by some programs

const REASONS = {
  stopped: "stopped",
  time: "stopped: the time limit was reached; a larger limit can be set beside the button Run",
  depth: "error: calls or values are nested too deeply for the browser; withy on your computer allows deeper nesting",
  memory: "error: the script needs more memory than the page allows (1 GB)",
  panic: "error: internal error of withy; this is a bug in withy, not in your script; please report it with the script",
};

let scripts = [];
let running = null;

/** Place of the error in the messages of a run, as in the first line of its drawing. */
function placeIn(messages) {
  const found = messages.match(/┌─ (.+):(\d+):(\d+)\n[^]*?(\^+)/);
  if (found?.[1] !== SCRIPT) return null;
  return { line: Number(found[2]), column: Number(found[3]), length: found[4].length };
}

function setRunning(job) {
  running = job;
  part("run").disabled = job !== null;
  part("stop").disabled = job === null;
}

async function run() {
  if (running || part("run").disabled) return;
  output.clear();
  let messages = "";
  const begun = performance.now();
  const job = start({
    args: ["run", SCRIPT],
    text: editor.text(),
    seconds: Number(part("limit").value) || 60,
    onText: (pieces) => {
      for (const { stream, text } of pieces) if (stream === 2) messages += text;
      output.addText(pieces);
    },
    onFile: (file) => output.addFile(file),
  });
  setRunning(job);
  status("running …");
  const result = await job.done;
  setRunning(null);
  const seconds = ((performance.now() - begun) / 1000).toFixed(1);
  if (result.reason) output.addMessage(REASONS[result.reason]);
  const place = result.code === 2 ? placeIn(messages) : null;
  if (place) editor.mark(place, messages.match(/error: (.*)/)?.[1] ?? "error");
  const endings = { 0: "finished", 1: "finished; some checks failed", 2: "ended by an error" };
  status(`${endings[result.code] ?? "ended early"} after ${seconds} s`);
}

function replaceText(text) {
  if (!scripts.some((script) => script.text === editor.text())) putAway(editor.text());
  editor.replace(text);
  listTexts();
}

/** Fills the list of scripts: those of the repository, and earlier texts of this browser. */
function listTexts() {
  const option = (value, label) => Object.assign(document.createElement("option"), { value, textContent: label });
  const group = (label, options) => {
    const created = Object.assign(document.createElement("optgroup"), { label });
    created.append(...options);
    return created;
  };
  const folders = [...new Set(scripts.map((script) => script.folder))];
  const own = earlier().map(({ text, time }, index) => {
    const first = text.split("\n").find((line) => line.trim()) ?? "";
    return option(`earlier ${index}`, `${new Date(time).toLocaleString()}: ${first.slice(0, 40)}`);
  });
  const groups = folders.map((folder) => {
    const inside = scripts.filter((script) => script.folder === folder);
    return group(folder, inside.map(({ name, title }) => option(`${folder}/${name}`, `${name}: ${title}`)));
  });
  part("scripts").replaceChildren(option("", "Open a script …"), ...groups, ...(own.length > 0 ? [group("earlier texts", own)] : []));
}

function openChosen() {
  const value = part("scripts").value;
  const chosen = value.startsWith("earlier ") ? earlier()[value.slice(8)] : scripts.find(({ folder, name }) => `${folder}/${name}` === value);
  if (chosen) replaceText(chosen.text);
}

async function copyLink() {
  const link = await toLink(editor.text());
  history.replaceState(null, "", link);
  const note = link.length > LONGEST_LINK ? `; it has ${link.length} characters, and some programs cut such links` : "";
  try {
    await navigator.clipboard.writeText(link);
    status(`the link is copied${note}`);
  } catch {
    status(`the link is in the address bar${note}`);
  }
}

function download() {
  const url = URL.createObjectURL(new Blob([editor.text()], { type: "text/plain" }));
  Object.assign(document.createElement("a"), { href: url, download: SCRIPT }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

async function openLink() {
  try {
    const text = await fromLink(location.hash);
    if (text !== null && text !== editor.text()) replaceText(text);
  } catch {
    status("the script in the link cannot be read: the link is damaged or cut off");
  }
}

const editor = createEditor(part("editor"), {
  text: kept() ?? part("first-script").textContent.trim() + "\n",
  keys: [
    { key: "Mod-Enter", run: () => (run(), true), preventDefault: true },
    { key: "Shift-Escape", run: () => (running?.stop(), true) },
  ],
  onChange: (text) => keep(text) || status("this browser does not store the text: use Download before you leave"),
  onHint: (text) => (part("hint").textContent = text),
});

part("run").addEventListener("click", run);
part("stop").addEventListener("click", () => running?.stop());
part("link").addEventListener("click", copyLink);
part("download").addEventListener("click", download);
part("scripts").addEventListener("change", openChosen);
addEventListener("hashchange", openLink);

async function begin() {
  listTexts();
  await openLink();
  fetch("scripts.json")
    .then(async (answer) => (scripts = await answer.json()))
    .then(listTexts)
    .catch(() => status("the list of scripts cannot be loaded"));
  try {
    await load();
    part("run").disabled = false;
    status("ready");
  } catch (error) {
    status(`the program cannot be loaded: ${error.message}; docs/playground/build creates the missing files`);
  }
}

begin();
