// Worker of one job. The first texts are sent at once, and further texts in batches, because a message for each line would block the page.
import { execute } from "./execute.js";

const SINGLE = 200; // texts that are sent at once
const INTERVAL = 50; // ms between batches
const BATCH = 1 << 16; // characters after which a batch is sent early
const MOST_TEXT = 1_000_000; // characters of a job that the page shows

onmessage = ({ data: { module, args, files } }) => {
  const decoders = { 1: new TextDecoder(), 2: new TextDecoder() };
  let pieces = [];
  let [count, length, total, sent] = [0, 0, 0, performance.now()];
  const flush = () => {
    if (pieces.length > 0) postMessage({ text: pieces });
    [pieces, length, sent] = [[], 0, performance.now()];
  };
  const add = (stream, text) => {
    const last = pieces.at(-1);
    if (last?.stream === stream) last.text += text;
    else pieces.push({ stream, text });
    length += text.length;
  };
  const onText = (stream, bytes) => {
    const text = decoders[stream].decode(bytes, { stream: true });
    // Messages are few, and the error at the end of a run must not be lost.
    if (stream === 1 && total > MOST_TEXT) return;
    total += text.length;
    add(stream, text);
    if (total > MOST_TEXT && stream === 1) add(2, `\nthe rest of the text is not shown: it is longer than ${MOST_TEXT} characters\n`);
    count += 1;
    if (count <= SINGLE || length > BATCH || performance.now() - sent > INTERVAL) flush();
  };
  const onFile = (name, bytes) => postMessage({ file: { name, bytes: bytes.slice() } });
  const result = execute(module, { args, files }, onText, onFile);
  flush();
  postMessage({ result });
};
