// Runs a script with the WebAssembly module of the page: node run_in_node.mjs SCRIPT FOLDER. Needs docs/playground/withy.wasm.
// The files of the script are written to FOLDER, and its text is printed. The worker of the page does the work.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const [script, folder] = process.argv.slice(2);
const page = new URL("../../docs/playground/", import.meta.url);
mkdirSync(folder, { recursive: true });

globalThis.onmessage = null;
globalThis.postMessage = ({ text, file, result }) => {
  for (const piece of text ?? []) (piece.stream === 1 ? process.stdout : process.stderr).write(piece.text);
  if (file) writeFileSync(join(folder, file.name), file.bytes);
  if (result) {
    if (result.reason) console.error(result);
    process.exitCode = result.code ?? 3;
  }
};
await import(new URL("bundle/worker.js", page));
const module = new WebAssembly.Module(readFileSync(new URL("withy.wasm", page)));
const files = { "script.rhai": readFileSync(script) };
globalThis.onmessage({ data: { module, args: ["run", "script.rhai"], files } });
