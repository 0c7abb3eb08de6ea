// Results of a run: printed text, pictures, viewers, and downloads of all files.

const TYPES = { svg: "image/svg+xml", png: "image/png", html: "text/html", csv: "text/csv", json: "application/json" };
const typeOf = (name) => TYPES[name.split(".").pop().toLowerCase()] ?? "application/octet-stream";

function sizeOf(bytes) {
  if (bytes < 1000) return `${bytes} B`;
  return bytes < 1e6 ? `${(bytes / 1e3).toFixed(1)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}

function element(name, properties, ...children) {
  const created = Object.assign(document.createElement(name), properties);
  created.append(...children);
  return created;
}

/** Picture or viewer of a file; `null` for other files. */
function preview(name, type, url) {
  if (type.startsWith("image/")) return element("img", { src: url, alt: `Picture ${name}` });
  if (type !== "text/html") return null;
  const frame = element("iframe", { title: `Viewer ${name}`, src: url });
  frame.setAttribute("sandbox", "allow-scripts allow-downloads");
  return frame;
}

/** Output of a run in the elements `printed`, `pictures` and `files`. */
export class Output {
  constructor({ printed, pictures, files }) {
    Object.assign(this, { printed, pictures, files, urls: new Map() });
  }

  clear() {
    for (const url of this.urls.values()) URL.revokeObjectURL(url);
    this.urls.clear();
    for (const part of [this.printed, this.pictures, this.files]) part.replaceChildren();
  }

  addText(pieces) {
    const isAtEnd = this.printed.scrollHeight - this.printed.scrollTop - this.printed.clientHeight < 40;
    for (const { stream, text } of pieces) {
      const className = text.startsWith("error") ? "error" : "message";
      this.printed.append(stream === 1 ? text : element("span", { className }, text));
    }
    if (isAtEnd) this.printed.scrollTop = this.printed.scrollHeight;
  }

  addMessage(text) {
    this.addText([{ stream: 2, text: `${text}\n` }]);
  }

  /** Adds a file, or replaces the file of this name. */
  addFile({ name, bytes }) {
    const type = typeOf(name);
    const url = URL.createObjectURL(new Blob([bytes], { type }));
    if (this.urls.has(name)) {
      URL.revokeObjectURL(this.urls.get(name));
      document.querySelectorAll(`[data-file="${CSS.escape(name)}"]`).forEach((old) => old.remove());
    }
    this.urls.set(name, url);
    const link = element("a", { href: url, download: name.split("/").pop() }, name);
    const item = element("li", {}, link, ` ${sizeOf(bytes.length)}`);
    item.dataset.file = name;
    this.files.append(item);
    const shown = preview(name, type, url);
    if (shown) {
      const figure = element("figure", {}, shown, element("figcaption", {}, name));
      figure.dataset.file = name;
      this.pictures.append(figure);
    }
  }
}
