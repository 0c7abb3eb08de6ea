// Text of a script in a link: compressed with deflate, in base64 for addresses.

const PREFIX = "#script=";

async function transformed(bytes, transform) {
  const stream = new Blob([bytes]).stream().pipeThrough(transform);
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export async function toLink(text) {
  const bytes = await transformed(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  const code = btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  return location.origin + location.pathname + PREFIX + code;
}

/** Text in the fragment of an address; `null` if there is none. Fails if the link is damaged. */
export async function fromLink(hash) {
  if (!hash.startsWith(PREFIX)) return null;
  const letters = atob(hash.slice(PREFIX.length).replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
  const text = await transformed(bytes, new DecompressionStream("deflate-raw"));
  return new TextDecoder("utf-8", { fatal: true }).decode(text);
}
