// Reading: from letters back to numbers over frames.

/** The bytes that were deflated and written as letters (base64). */
async function inflated(letters) {
  const bytes = Uint8Array.from(atob(letters), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** So many numbers over so many frames, each `origin + step · code`; one code stands for what is missing. */
class Series {
  static MISSING = 0xffff;

  constructor({ origin, step, numbers, frames }, codes) {
    Object.assign(this, { origin, step, numbers, frames, codes });
  }

  static async read(packed) {
    const bytes = await inflated(packed.data);
    const { numbers, frames, order } = packed;
    const count = numbers * frames;
    if (bytes.length !== 2 * count) throw new Error("the data of this page are cut off");
    const codes = new Uint16Array(count);
    for (let number = 0; number < numbers; number++) {
      let code = 0;
      let change = 0;
      for (let at = number * frames; at < (number + 1) * frames; at++) {
        // The high bytes come first; small differences of either sign were made small numbers.
        const word = (bytes[at] << 8) | bytes[count + at];
        const difference = (word >>> 1) ^ -(word & 1);
        change = order === 2 ? (change + difference) & 0xffff : difference;
        code = (code + change) & 0xffff;
        codes[at] = code;
      }
    }
    return new Series(packed, codes);
  }

  at(number, frame) {
    const code = this.codes[number * this.frames + frame];
    return code === Series.MISSING ? NaN : this.origin + this.step * code;
  }

  /** The least and the greatest of all numbers. */
  range() {
    return (this.limits ??= this.found());
  }

  found() {
    let least = Infinity;
    let greatest = -Infinity;
    for (const code of this.codes) {
      if (code === Series.MISSING) continue;
      if (code < least) least = code;
      if (code > greatest) greatest = code;
    }
    return [this.origin + this.step * least, this.origin + this.step * greatest];
  }
}
