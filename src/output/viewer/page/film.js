// A film: a motion in frames, all of which the solver has computed; none is made up between them.

class Film {
  static async read(raw) {
    const film = Object.assign(new Film(), raw);
    [film.x, film.y, film.loads] = await Promise.all([raw.x, raw.y, raw.arrows.values].map(Series.read));
    film.arrows = raw.arrows.all;
    const withValues = async (one) => ({ ...one, values: await Series.read(one.values) });
    film.fields = await Promise.all(raw.fields.map(withValues));
    film.columns = await Promise.all(raw.history.columns.map(withValues));
    film.rows = raw.history.times;
    film.paths = new Map();
    let stations = 0;
    for (const beam of film.beams) {
      beam.shape = raw.shapes[beam.shape];
      beam.firstStation = stations;
      stations += beam.shape.stations.length;
    }
    return film;
  }

  get start() { return this.times[0]; }
  get end() { return this.times[this.times.length - 1]; }

  /** The frame nearest to a time. */
  frameAt(time) { return nearest(this.times, time); }

  /** Where a place is, its points counted from `from`. */
  at([first, weights], frame, from = 0) {
    let x = 0;
    let y = 0;
    for (let index = 0; index < weights.length; index++) {
      x += weights[index] * this.x.at(from + first + index, frame);
      y += weights[index] * this.y.at(from + first + index, frame);
    }
    return [x, y];
  }

  /** The outline of a rigid body: through its places, or a polygon that its centre and one of its points carry along. */
  outline({ outline, corners }, frame) {
    const line = outline.map((at) => this.at(at, frame));
    if (corners.length === 0) return line;
    const [[x, y], [tipX, tipY]] = line;
    const [along, up] = [tipX - x, tipY - y];
    return corners.map(([far, left]) => [x + far * along - left * up, y + far * up + left * along]);
  }

  /** Where a spring is attached: at places that move, and at points of the ground. */
  way(spring, frame) { return spring.anchors.map((anchor) => (Array.isArray(anchor) ? this.at(anchor, frame) : [anchor.x, anchor.y])); }

  /** Supports, joints, drives and sliders: what has left its beam is none any more. */
  held(frame) { return this.symbols.filter(({ until }) => until === null || this.times[frame] <= until); }

  /** Springs, dampers and tendons that have not let go. */
  holding(frame) { return this.springs.filter(({ until }) => until === null || this.times[frame] <= until); }

  /** The centre line of a beam. */
  line(beam, frame) { return beam.shape.line.map((place) => this.at(place, frame, beam.first)); }

  /** Where a place is in all frames. */
  path(place) {
    if (!this.paths.has(place)) this.paths.set(place, this.times.map((_, frame) => this.at(place, frame)));
    return this.paths.get(place);
  }

  /** The value of a field at each point of the line of a beam: linear between its stations. */
  along(field, beam, frame) {
    const { stations, line } = beam.shape;
    const value = (station) => field.values.at(beam.firstStation + station, frame);
    const values = new Array(line.length).fill(NaN);
    for (let station = 0; station < stations.length; station++) {
      const [here, next] = [stations[station], stations[station + 1] ?? line.length];
      const [a, b] = [value(station), station + 1 < stations.length ? value(station + 1) : value(station)];
      for (let at = here; at < next; at++) values[at] = a + ((b - a) * (at - here)) / (next - here);
    }
    return values;
  }

  /** The box around everything in one frame. */
  box(frame) {
    const box = new Box();
    for (const beam of this.beams) for (const point of this.line(beam, frame)) box.add(point);
    for (const { at } of [...this.particles, ...this.symbols, ...this.bodies]) box.add(this.at(at, frame));
    for (const body of this.bodies) for (const point of this.outline(body, frame)) box.add(point);
    for (const spring of this.springs) for (const point of this.way(spring, frame)) box.add(point);
    return box;
  }

  /** The box around the motion, from at most two hundred of its frames, the paths that are drawn, and obstacles. */
  whole() {
    const box = new Box();
    const every = Math.max(1, Math.floor(this.times.length / 200));
    for (let frame = 0; frame < this.times.length; frame += every) box.join(this.box(frame));
    box.join(this.box(this.times.length - 1));
    for (const { at } of this.trails) for (const point of this.path(at)) box.add(point);
    for (const { shown } of this.obstacles) shown.forEach((point) => box.add(point));
    return box;
  }
}

/** The index of the number nearest to `value` in increasing numbers. */
function nearest(numbers, value) {
  let low = 0;
  let high = numbers.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (numbers[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low > 0 && value - numbers[low - 1] < numbers[low] - value ? low - 1 : low;
}

/** A box with sides along the axes, empty at first. */
class Box {
  left = Infinity;
  right = -Infinity;
  bottom = Infinity;
  top = -Infinity;

  add([x, y]) {
    if (!Number.isFinite(x + y)) return;
    this.left = Math.min(this.left, x);
    this.right = Math.max(this.right, x);
    this.bottom = Math.min(this.bottom, y);
    this.top = Math.max(this.top, y);
  }

  join(other) {
    this.add([other.left, other.bottom]);
    this.add([other.right, other.top]);
  }

  get centre() { return [(this.left + this.right) / 2, (this.bottom + this.top) / 2]; }
}
