// The time of the motion, and how it passes.

class Clock {
  isPlaying = false;

  constructor(start, end) {
    Object.assign(this, { start, end, time: start });
    // All of it in about ten seconds.
    this.rate = roundNear((end - start) / 10 || 1);
  }

  seek(time) { this.time = Math.min(Math.max(time, this.start), this.end); }

  /** Lets seconds pass; at its end the motion begins anew. */
  pass(seconds) {
    const next = this.time + seconds * this.rate;
    this.time = next > this.end ? this.start : next;
  }

  faster() { this.rate = roundNear(this.rate * 2.1); }
  slower() { this.rate = roundNear(this.rate / 2.1); }
}

/** The nearest of 1, 2, 5, 10, … */
function roundNear(number) {
  const power = 10 ** Math.floor(Math.log10(number));
  const near = (one) => Math.abs(Math.log(one / (number / power)));
  return Number(([1, 2, 5, 10].sort((a, b) => near(a) - near(b))[0] * power).toPrecision(1));
}
