// The viewer: films on their stages, charts below, one time and one view for all.

/** Most films that are shown at first. */
const SHOWN_AT_FIRST = 4;

class Viewer {
  static async read(data) {
    const films = await Promise.all(data.films.map(Film.read));
    return new Viewer(data, films);
  }

  constructor({ hues }, films) {
    Object.assign(this, { films, hues, view: new View(), theme: new Theme(), field: null });
    this.clock = new Clock(Math.min(...films.map(({ start }) => start)), Math.max(...films.map(({ end }) => end)));
    this.switches = { trails: true, knots: films.every(({ beams }) => beams.length <= 10), symbols: true, loads: true, follow: false };
    this.panels = films.map((film, index) => this.panel(film, index));
    this.ranges = new Map();
    for (const { charts } of this.panels) {
      for (const chart of charts) {
        const [low, high] = chart.range();
        const [least, most] = this.ranges.get(chart.unit) ?? [Infinity, -Infinity];
        this.ranges.set(chart.unit, [Math.min(low, least), Math.max(high, most)]);
      }
    }
    const names = films.flatMap(({ fields }) => fields.map(({ name }) => name));
    this.fieldNames = [...new Set(names)];
    /** The closest view: an error of half a step of the places is a pixel. */
    this.exactness = Math.max(...films.map(({ x }) => x.step)) / 2;
  }

  panel(film, index) {
    const section = document.createElement("section");
    if (this.films.length > 1) section.append(Object.assign(document.createElement("h2"), { textContent: film.label }));
    const canvas = Object.assign(document.createElement("canvas"), { className: "stage" });
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `the motion of ${film.label}`);
    const reading = Object.assign(document.createElement("div"), { className: "reading" });
    section.append(canvas, reading);
    section.hidden = this.films.length > SHOWN_AT_FIRST && index >= 2;
    document.getElementById("films").append(section);
    const units = new Map();
    for (const column of film.columns) units.set(column.unit, [...(units.get(column.unit) ?? []), column]);
    const charts = [...units].map(([unit, columns]) => new Chart(section, film, unit, columns));
    return { section, reading, film, stage: new Stage(canvas, film), charts };
  }

  get shown() { return this.panels.filter(({ section }) => !section.hidden); }

  /** Shows the whole motion of all films that are shown. */
  fit() {
    const box = new Box();
    for (const { film } of this.shown) {
      film.extent ??= film.whole();
      box.join(film.extent);
    }
    const sizes = this.shown.map(({ stage }) => stage.sheet.canvas.getBoundingClientRect());
    if (sizes.length === 0) return;
    this.view.fit(box, { width: Math.min(...sizes.map(({ width }) => width)), height: Math.min(...sizes.map(({ height }) => height)) });
  }

  zoom(factor, at, size) {
    const { stage } = this.shown[0] ?? {};
    if (!stage) return;
    const around = size ?? stage.size;
    const finest = this.exactness > 0 ? 1 / this.exactness : Infinity;
    this.view.zoom(factor, at ?? [around.width / 2, around.height / 2], around, Math.max(finest, this.view.fitted));
  }

  /** How a field is coloured: the same in all films. */
  shading(film) {
    const field = film.fields.findIndex(({ name }) => name === this.field);
    if (field < 0) return null;
    const ranges = this.films.flatMap(({ fields }) => fields.filter(({ name }) => name === this.field).map(({ values }) => values.range()));
    let [low, high] = [Math.min(...ranges.map(([least]) => least)), Math.max(...ranges.map(([, most]) => most))];
    const isSigned = low < 0 && high > 0;
    if (isSigned) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
    return { field, low, high, isSigned };
  }

  draw() {
    const { view, theme, hues, switches, ranges, clock } = this;
    if (switches.follow && this.shown.length > 0) {
      const { film } = this.shown[0];
      view.centre = film.box(film.frameAt(clock.time)).centre;
    }
    for (const { film, stage, charts } of this.shown) {
      stage.draw(film.frameAt(clock.time), { view, theme, hues, switches, shading: this.field && this.shading(film) });
      for (const chart of charts) chart.draw(clock.time, { theme, hues, ranges, start: clock.start, end: clock.end });
    }
  }

  /** Goes so many frames on or back: those of all films that are shown count. */
  stepFrames(count) {
    const times = [...new Set(this.shown.flatMap(({ film }) => film.times))].sort((a, b) => a - b);
    if (times.length === 0) return;
    const at = nearest(times, this.clock.time) + count;
    this.clock.seek(times[Math.min(Math.max(at, 0), times.length - 1)]);
  }

  /** What is at a place of a stage, in words. */
  read({ film, stage }, [x, y]) {
    const frame = film.frameAt(this.clock.time);
    let found = { distance: 14, words: "" };
    const look = (name, point, more = "") => {
      const [px, py] = this.view.toScreen(point, stage.size);
      const distance = Math.hypot(px - x, py - y);
      if (distance < found.distance) found = { distance, words: `${name}: (${shown(point[0], 5)}, ${shown(point[1], 5)})${more}` };
    };
    for (const beam of film.beams) {
      const field = film.fields.find(({ name }) => name === this.field);
      const values = field && film.along(field, beam, frame);
      film.line(beam, frame).forEach((point, at) => look(beam.name, point, field ? `, ${field.name} ${shown(values[at])}` : ""));
    }
    found.distance += 2;
    const ofBodies = film.bodies.flatMap((body) => [body, ...body.points]);
    for (const { name, at } of [...film.particles, ...ofBodies, ...film.held(frame), ...film.arrows]) look(name, film.at(at, frame));
    for (const { name, at } of film.obstacles) look(name, at);
    for (const spring of film.holding(frame)) film.way(spring, frame).forEach((point) => look(spring.name, point));
    return found.words;
  }
}
