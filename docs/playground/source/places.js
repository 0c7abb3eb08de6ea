// Conversion between places of the program, in bytes or characters, and positions of the editor, in UTF-16 units.

const encoder = new TextEncoder();

export const toByte = (text, position) => encoder.encode(text.slice(0, position)).length;

export const fromByte = (text, byte) => new TextDecoder().decode(encoder.encode(text).slice(0, byte)).length;

/** Range of the document for a line and column, counted from 1 in characters. */
export function range(doc, { line, column, length }) {
  const { from, text } = doc.line(Math.min(Math.max(line, 1), doc.lines));
  const characters = [...text];
  const units = (count) => characters.slice(0, count).join("").length;
  const start = from + units(column - 1);
  return { from: start, to: Math.max(from + units(column - 1 + length), start) };
}
