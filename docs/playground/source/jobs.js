// Jobs of the playground program. Each job has its own worker and instance; the compiled module is shared.

let module;
let workerUrl;

/** Loads and compiles the program. Afterwards, jobs need no network. */
export async function load() {
  const [compiled, worker] = await Promise.all([WebAssembly.compileStreaming(fetch("withy.wasm")), fetch("bundle/worker.js")]);
  if (!worker.ok) throw new Error(`bundle/worker.js: ${worker.status}`);
  module = compiled;
  workerUrl = URL.createObjectURL(await worker.blob());
}

/** Name of the script in the folder of a job, and in error messages. */
export const SCRIPT = "script.rhai";

/**
 * Starts a job: a command of the program and its arguments. The folder of the job has the script `text`. `done` is a promise of the result of
 * `execute`, or of the reason `stopped` or `time`. `stop` ends the job at once.
 */
export function start({ args, text = "", seconds, onText = () => {}, onFile = () => {} }) {
  const worker = new Worker(workerUrl);
  let finish;
  const done = new Promise((resolve) => {
    finish = (result) => {
      clearTimeout(timer);
      worker.terminate();
      resolve(result);
    };
  });
  const timer = setTimeout(() => finish({ reason: "time" }), 1000 * seconds);
  worker.onmessage = ({ data }) => {
    if (data.text) onText(data.text);
    if (data.file) onFile(data.file);
    if (data.result) finish(data.result);
  };
  worker.onerror = (event) => finish({ reason: "panic", error: event.message });
  const files = { [SCRIPT]: new TextEncoder().encode(text) };
  worker.postMessage({ module, args, files });
  return { done, stop: () => finish({ reason: "stopped" }) };
}

/** Runs a job that prints JSON. Returns the value, or `null` if the job failed or took too long. */
export function ask(args, text) {
  let printed = "";
  const onText = (pieces) => {
    for (const { stream, text } of pieces) if (stream === 1) printed += text;
  };
  const job = start({ args, text, seconds: 5, onText });
  const value = job.done.then(({ code }) => (code === 0 ? JSON.parse(printed) : null));
  return { value, stop: job.stop };
}
