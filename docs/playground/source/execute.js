// Execution of the playground program (src/playground) as a WebAssembly module, in a worker or in node.
import { ConsoleStdout, File, OpenFile, PreopenDirectory, WASI } from "@bjorn3/browser_wasi_shim";

/** Folder of the run. Calls `onFile(name, bytes)` for each file that the program completes by giving it its final name. */
class RunFolder extends PreopenDirectory {
  constructor(files, onFile) {
    super(".", files);
    this.onFile = onFile;
  }

  path_link(path, inode, allowDirectory) {
    const result = super.path_link(path, inode, allowDirectory);
    const name = path.replace(/^\.\//, "");
    if (result === 0 && inode instanceof File && !isHidden(name)) this.onFile(name, inode.data);
    return result;
  }
}

const isHidden = (name) => name.split("/").pop().startsWith(".");

/** Reason why the program ended early; `undefined` after a normal end. */
function reasonOf(error, messages) {
  const isOverflow = error instanceof RangeError || error.name === "InternalError" || /out of bounds/.test(error.message);
  if (/memory allocation of \d+ bytes failed|capacity overflow/.test(messages)) return "memory";
  if (/panicked at/.test(messages)) return "panic";
  return isOverflow ? "depth" : "panic";
}

/**
 * Runs the program with arguments and files (a map from names to bytes). `onText(stream, bytes)` receives the text
 * printed to stream 1 (output) or 2 (messages). Returns the exit code, or the reason why there is none.
 */
export function execute(module, { args, files }, onText, onFile) {
  let messages = "";
  const decoder = new TextDecoder();
  const message = (bytes) => {
    messages = (messages + decoder.decode(bytes, { stream: true })).slice(-2000);
    onText(2, bytes);
  };
  const entries = Object.entries(files).map(([name, bytes]) => [name, new File(bytes)]);
  const descriptors = [
    new OpenFile(new File([])),
    new ConsoleStdout((bytes) => onText(1, bytes)),
    new ConsoleStdout(message),
    new RunFolder(new Map(entries), onFile),
  ];
  const wasi = new WASI(["playground", ...args], [], descriptors, { debug: false });
  const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: wasi.wasiImport });
  try {
    return { code: wasi.start(instance) };
  } catch (error) {
    return { reason: reasonOf(error, messages), error: String(error) };
  }
}
