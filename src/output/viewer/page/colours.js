// Colours and numbers as they are shown.

/** Stations of viridis (Smith and van der Walt, matplotlib), from dark to pale. */
const VIRIDIS = [[68, 1, 84], [70, 50, 127], [54, 92, 141], [39, 127, 142], [31, 161, 135], [74, 194, 109], [159, 218, 58], [253, 231, 37]];
/** From one sign through little to the other: blue and vermilion of Okabe and Ito (2008). */
const SIGNED = { light: [[0, 90, 160], [120, 170, 210], [186, 190, 196], [235, 160, 100], [200, 75, 0]], dark: [[86, 180, 233], [60, 120, 160], [92, 98, 106], [190, 110, 40], [255, 150, 40]] };

/** What the style sheet says of light or dark. */
class Theme {
  constructor() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ["paper", "ink", "grey", "axis", "grid", "focus"]) this[name] = style.getPropertyValue(`--${name}`).trim();
    this.isDark = matchMedia("(prefers-color-scheme: dark)").matches;
  }

  /** The colour of a beam or column: paler on dark paper. */
  hue(hues, index) {
    const hue = hues[index % hues.length];
    return `rgb(${this.isDark ? hue.map((part) => Math.round(part + 0.3 * (255 - part))) : hue})`;
  }

  /** The colour at a part of a range; ranges with both signs have a middle. What stands out from the paper is the large. */
  shade(part, isSigned) {
    const stations = isSigned ? SIGNED[this.isDark ? "dark" : "light"] : VIRIDIS;
    const along = isSigned || this.isDark ? part : 0.92 * (1 - part);
    const place = Math.min(Math.max(along, 0), 1) * (stations.length - 1);
    const below = Math.min(Math.floor(place), stations.length - 2);
    const mixed = stations[below].map((from, at) => Math.round(from + (place - below) * (stations[below + 1][at] - from)));
    return `rgb(${mixed})`;
  }
}

/** A number for people. */
function shown(value, digits = 4) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e");
  return String(Number(value.toPrecision(digits)));
}

/** A number that is known to a step, rounded to a power of ten that is not below it. */
function known(value, step) {
  if (!(step > 0)) return value;
  const unit = 10 ** Math.ceil(Math.log10(step));
  return Math.round(value / unit) * unit;
}

/** Round places of an axis from `low` to `high`, about so many, each with its number. */
function ticks(low, high, about) {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return [];
  const rough = span / Math.max(about, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough * 0.999);
  const digits = Math.max(1, Math.ceil(Math.log10(Math.max(Math.abs(low), Math.abs(high)) / step)) + 1);
  const places = [];
  for (let index = Math.ceil(low / step - 1e-9); index * step <= high + 1e-9 * step; index++) {
    places.push({ at: index * step, text: index === 0 ? "0" : shown(index * step, Math.min(digits, 15)) });
  }
  return places;
}
