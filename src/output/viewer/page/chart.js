// A chart: columns of the history over time, with a cursor that is the time.

class Chart {
  /** Columns that have the same unit, of one film. */
  constructor(section, film, unit, columns) {
    Object.assign(this, { film, unit, columns });
    this.legend = Object.assign(document.createElement("div"), { className: "legend" });
    const canvas = Object.assign(document.createElement("canvas"), { className: "chart" });
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${columns.map(({ name }) => name).join(", ")} over time`);
    section.append(this.legend, canvas);
    this.sheet = new Sheet(canvas);
    this.values = columns.map(({ name }) => {
      const item = document.createElement("span");
      const value = document.createElement("span");
      item.append(document.createElement("i"), `${name} `, value);
      this.legend.append(item);
      return { item, value };
    });
    if (unit && unit !== "-") this.legend.append(Object.assign(document.createElement("span"), { className: "unit", textContent: `[${unit}]` }));
  }

  /** The least and the greatest of its values. */
  range() {
    const ranges = this.columns.map(({ values }) => values.range());
    return [Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high))];
  }

  /** The time at a place of the screen. */
  timeAt(x) { return this.start + ((x - this.left) / this.plotWidth) * (this.end - this.start); }

  draw(time, { theme, hues, start, end, ranges }) {
    const { sheet, film } = this;
    sheet.begin(theme.paper);
    let [low, high] = ranges.get(this.unit);
    // Rounding is not blown up to the height of the chart.
    const least = 1e-9 * Math.max(Math.abs(low), Math.abs(high)) || 1;
    if (high - low < least) [low, high] = [low - least, high + least];
    const spare = 0.06 * (high - low);
    [low, high] = [low - spare, high + spare];
    const upright = ticks(low, high, sheet.height / 34);
    const widest = Math.max(24, ...upright.map(({ text }) => sheet.context.measureText(text).width));
    const [left, right, top, bottom] = [widest + 10, sheet.width - 12, 6, sheet.height - 20];
    Object.assign(this, { left, plotWidth: right - left, start, end });
    const x = (at) => left + ((at - start) / (end - start || 1)) * (right - left);
    const y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
    for (const { at, text } of upright) {
      sheet.line([[left, y(at)], [right, y(at)]], theme.grid, 1);
      sheet.text(text, left - 6, y(at) + 4, theme.grey, "right");
    }
    for (const { at, text } of ticks(start, end, sheet.width / 90)) {
      sheet.line([[x(at), top], [x(at), bottom]], theme.grid, 1);
      if (x(at) < right - 16) sheet.text(text, x(at), sheet.height - 5, theme.grey, "center");
    }
    sheet.text("t", right, sheet.height - 5, theme.grey, "center");
    const row = nearest(film.rows, time);
    this.columns.forEach(({ values }, index) => {
      const colour = theme.hue(hues, index);
      sheet.line(film.rows.map((at, row) => [x(at), y(values.at(0, row))]), colour, 1.5, index < hues.length ? [] : [5, 4]);
      sheet.disc([x(film.rows[row]), y(values.at(0, row))], 3, colour);
      this.values[index].value.textContent = shown(known(values.at(0, row), values.step), 6);
      this.values[index].item.querySelector("i").style.background = colour;
    });
    sheet.line([[x(time), top], [x(time), bottom]], theme.ink, 1);
  }
}
