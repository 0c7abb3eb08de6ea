// A stage: the canvas on which one film moves.

/** A canvas as sharp as the screen, drawn on in the pixels of the style sheet. */
class Sheet {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
  }

  /** Makes it as large as it is shown, and blank. */
  begin(paper) {
    const { width, height } = this.canvas.getBoundingClientRect();
    const ratio = window.devicePixelRatio || 1;
    const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== wide || this.canvas.height !== high) Object.assign(this.canvas, { width: wide, height: high });
    Object.assign(this, { width, height });
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    Object.assign(this.context, { fillStyle: paper, lineJoin: "round", lineCap: "round", font: "12px system-ui, sans-serif" });
    this.context.fillRect(0, 0, width, height);
  }

  line(points, colour, width, dash = []) {
    const { context } = this;
    Object.assign(context, { strokeStyle: colour, lineWidth: width });
    context.setLineDash(dash);
    context.beginPath();
    points.forEach(([x, y], index) => (index === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
    context.stroke();
    context.setLineDash([]);
  }

  shape(points, fill, colour, width = 1.5) {
    this.context.fillStyle = fill;
    this.context.beginPath();
    points.forEach(([x, y], index) => (index === 0 ? this.context.moveTo(x, y) : this.context.lineTo(x, y)));
    this.context.closePath();
    this.context.fill();
    this.line([...points, points[0]], colour, width);
  }

  disc([x, y], radius, fill, colour) {
    const { context } = this;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = fill;
    context.fill();
    if (!colour) return;
    Object.assign(context, { strokeStyle: colour, lineWidth: 1.5 });
    context.stroke();
  }

  text(text, x, y, colour, align = "left") {
    Object.assign(this.context, { fillStyle: colour, textAlign: align, textBaseline: "alphabetic" });
    this.context.fillText(text, x, y);
  }
}

class Stage {
  constructor(canvas, film) {
    this.sheet = new Sheet(canvas);
    this.film = film;
  }

  get size() { return this.sheet; }

  draw(frame, { view, theme, hues, switches, shading }) {
    const { sheet, film } = this;
    sheet.begin(theme.paper);
    const place = (point) => view.toScreen(point, sheet);
    this.drawGrid(view, theme);
    if (switches.trails) {
      film.trails.forEach(({ at }, index) => {
        const colour = theme.hue(hues, (film.beams.length > 1 ? film.beams.length : 1) + index);
        sheet.line(film.path(at).slice(0, frame + 1).map(place), colour, 1.4);
      });
    }
    for (const obstacle of film.obstacles) drawObstacle(sheet, obstacle, place(obstacle.at), view.scale, theme);
    for (const body of film.bodies) {
      drawBody(sheet, film.outline(body, frame).map(place), body.points.map(({ at }) => place(film.at(at, frame))), place(film.at(body.at, frame)), theme);
    }
    if (switches.symbols) for (const spring of film.holding(frame)) drawSpring(sheet, spring, film.way(spring, frame).map(place), theme);
    film.beams.forEach((beam, index) => {
      const line = film.line(beam, frame).map(place);
      if (shading) this.drawShaded(line, film.along(film.fields[shading.field], beam, frame), shading, theme);
      else sheet.line(line, theme.hue(hues, index), 3);
      // On a coloured line they must not hide the colour.
      if (switches.knots) beam.shape.marks.forEach((mark) => sheet.disc(line[mark], shading ? 1.4 : 2.6, shading ? theme.paper : theme.ink));
    });
    for (const { at } of film.particles) sheet.disc(place(film.at(at, frame)), 6, theme.ink, theme.paper);
    if (switches.symbols) for (const symbol of film.held(frame)) drawSymbol(sheet, symbol, place(film.at(symbol.at, frame)), theme);
    if (switches.loads) {
      film.arrows.forEach(({ kind, at }, index) => {
        const value = [film.loads.at(2 * index, frame), film.loads.at(2 * index + 1, frame)];
        drawLoad(sheet, kind, place(film.at(at, frame)), value, theme);
      });
    }
  }

  /** The plane behind the motion, with equal units along both axes. */
  drawGrid(view, theme) {
    const { sheet } = this;
    const { width, height } = sheet;
    const [[left, top], [right, bottom]] = [view.toPlane([0, 0], sheet), view.toPlane([width, height], sheet)];
    const marks = [ticks(left, right, width / 60), ticks(bottom, top, height / 60)];
    for (const { at } of marks[0]) {
      const [x] = view.toScreen([at, 0], sheet);
      sheet.line([[x, 0], [x, height]], theme.grid, 1);
    }
    for (const { at } of marks[1]) {
      const [, y] = view.toScreen([0, at], sheet);
      sheet.line([[0, y], [width, y]], theme.grid, 1);
    }
    for (const { at, text } of marks[0]) {
      const [x] = view.toScreen([at, 0], sheet);
      if (x > 46 && x < width - 24) sheet.text(text, x, height - 6, theme.grey, "center");
    }
    for (const { at, text } of marks[1]) {
      const [, y] = view.toScreen([0, at], sheet);
      if (y > 16 && y < height - 24) sheet.text(text, 4, y - 3, theme.grey);
    }
    sheet.text("x", width - 12, height - 6, theme.grey);
    sheet.text("y", 4, 12, theme.grey);
  }

  /** A line in the colours of a field, in pieces of the same shade. */
  drawShaded(line, values, { low, high, isSigned }, theme) {
    const shade = (value) => (Number.isFinite(value) ? theme.shade((value - low) / (high - low || 1), isSigned) : theme.axis);
    let piece = [line[0]];
    let colour = shade(values[0]);
    for (let at = 1; at < line.length; at++) {
      const next = shade((values[at - 1] + values[at]) / 2);
      if (next !== colour && piece.length > 1) {
        this.sheet.line(piece, colour, 6);
        piece = [line[at - 1]];
      }
      colour = next;
      piece.push(line[at]);
    }
    this.sheet.line(piece, colour, 6);
  }
}

/** Points given along a direction and to the left of it, as the paper has them: y goes down. */
function around([x, y], angle, points) {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return points.map(([along, left]) => [x + along * cos - left * sin, y - along * sin - left * cos]);
}

/** A rigid body: its outline, its points, and a disc in quarters at its centre of mass. */
function drawBody(sheet, outline, points, centre, theme) {
  if (outline.length > 3) sheet.shape(outline, theme.grid, theme.ink, 2);
  else if (outline.length > 0) sheet.line(outline, theme.ink, 3);
  for (const point of points) sheet.disc(point, 2.6, theme.ink);
  sheet.disc(centre, 5, theme.paper, theme.ink);
  const quarter = (from) => Array.from({ length: 9 }, (_, index) => [5, from + (Math.PI * index) / 16]);
  for (const from of [0, Math.PI]) {
    const arc = quarter(from).map(([radius, angle]) => [radius * Math.cos(angle), radius * Math.sin(angle)]);
    sheet.shape(around(centre, 0, [[0, 0], ...arc]), theme.ink, theme.ink, 0.5);
  }
}

/** Draws a wall across the whole stage with hatching behind it, or a disc. */
function drawObstacle(sheet, { kind, direction: [dx, dy] }, at, scale, theme) {
  if (kind === "disc") return sheet.disc(at, Math.hypot(dx, dy) * scale, `${theme.grid}66`, theme.ink);
  const [angle, every] = [Math.atan2(dy, dx), 9];
  const [x, y] = [sheet.width / 2 - at[0], sheet.height / 2 - at[1]];
  const whole = (length) => Math.round(length / every) * every;
  // The hatching is at whole distances from the point of the wall, so that it moves with the view.
  const [middle, reach] = [whole(-x * Math.sin(angle) - y * Math.cos(angle)), whole(sheet.width + sheet.height)];
  for (let left = middle - reach; left < middle + reach; left += every) sheet.line(around(at, angle, [[0, left], [-7, left - 7]]), theme.axis, 1);
  sheet.line(around(at, angle, [[0, middle - reach], [0, middle + reach]]), theme.ink, 1.5);
}

/** What holds, joins, slides or drives. Behind a support, away from what it holds, is the ground. */
function drawSymbol(sheet, { kind, angle }, at, theme) {
  const up = Math.PI / 2;
  const ground = (behind, from) => {
    sheet.line(around(at, behind, [[-from, -12], [-from, 12]]), theme.ink, 1.5);
    for (const side of [-9, -3, 3, 9]) sheet.line(around(at, behind, [[-from, side], [-from - 5, side - 4]]), theme.ink, 1);
  };
  const rollers = (from) => {
    for (const centre of around(at, angle, [[-from - 2.5, -5], [-from - 2.5, 5]])) sheet.disc(centre, 2.5, theme.paper, theme.ink);
    ground(angle, from + 5.5);
  };
  const triangle = (behind) => sheet.shape(around(at, behind, [[0, 0], [-13, -8], [-13, 8]]), theme.paper, theme.ink);
  const square = (half, fill) => sheet.shape(around(at, 0, [[-half, -half], [half, -half], [half, half], [-half, half]]), fill, theme.ink);
  const head = (tip, direction) => sheet.line(around(tip, direction, [[-6, 3.5], [0, 0], [-6, -3.5]]), theme.ink, 1.5);
  const draw = {
    hinge() {
      triangle(up);
      ground(up, 13);
    },
    clamp() {
      sheet.line(around(at, angle, [[0, -12], [0, 12]]), theme.ink, 2.5);
      for (const y of [-9, -3, 3, 9]) sheet.line(around(at, angle, [[0, y], [-6, y - 4]]), theme.ink, 1);
    },
    roller() {
      triangle(angle);
      rollers(13);
    },
    guided() {
      sheet.line(around(at, angle, [[-4, -11], [-4, 11]]), theme.ink, 2);
      rollers(4);
      square(3, theme.ink);
    },
    held_angle() { square(6, theme.paper); },
    motor() {
      const circle = Array.from({ length: 49 }, (_, index) => (Math.PI * index) / 24);
      sheet.line(circle.flatMap((turn) => around(at, turn, [[11, 0]])), theme.ink, 1.2);
      for (const turn of [0.9, 0.9 + Math.PI]) head(around(at, turn, [[11, 0]])[0], turn + up);
    },
    carriage() {
      sheet.line(around(at, 0, [[-7, -7], [7, -7], [7, 7], [-7, 7], [-7, -7]]), theme.ink, 1.5);
      for (const direction of [angle, angle + Math.PI]) {
        sheet.line(around(at, direction, [[7, 0], [19, 0]]), theme.ink, 1.5);
        head(around(at, direction, [[19, 0]])[0], direction);
      }
    },
    joint() { sheet.disc(at, 4, theme.paper, theme.ink); },
    rigid_joint() { sheet.shape(around(at, angle, [[-3, -3], [3, -3], [3, 3], [-3, 3]]), theme.ink, theme.ink); },
    slider() { sheet.shape(around(at, 0, [[-7, 0], [0, -7], [7, 0], [0, 7]]), theme.paper, theme.ink); },
  };
  draw[kind]();
}

/** A spring between its ends, in as many turns as fit; a piston in its cylinder; the way of a tendon; a spiral about a section. */
function drawSpring(sheet, { kind, anchors }, way, theme) {
  const [from, to] = [way[0], way[way.length - 1]];
  const [length, angle] = [Math.hypot(to[0] - from[0], to[1] - from[1]), Math.atan2(from[1] - to[1], to[0] - from[0])];
  const lines = (...all) => all.forEach((points) => sheet.line(around(from, angle, points), theme.ink, 1.4));
  const draw = {
    spring() {
      const [lead, turns] = [Math.min(8, 0.15 * length), Math.min(Math.max(Math.round(length / 12), 3), 12)];
      const teeth = Array.from({ length: 2 * turns }, (_, at) => [lead + ((at + 0.5) * (length - 2 * lead)) / (2 * turns), at % 2 === 0 ? 5 : -5]);
      lines([[0, 0], [lead, 0], ...teeth, [length - lead, 0], [length, 0]]);
    },
    damper() {
      const [middle, half] = [length / 2, Math.min(9, 0.2 * length)];
      lines([[0, 0], [middle - half, 0]], [[middle + half, 5], [middle - half, 5], [middle - half, -5], [middle + half, -5]]);
      lines([[middle, 4], [middle, -4]], [[middle, 0], [length, 0]]);
    },
    tendon() { sheet.line(way, theme.ink, 1.2); },
    torsion_spring() {
      const at = way[anchors.findLastIndex(Array.isArray)] ?? to;
      const turn = Array.from({ length: 49 }, (_, index) => [(5 * Math.PI * index) / 48, 3 + (10 * index) / 48]);
      sheet.line(turn.flatMap(([angle, radius]) => around(at, angle, [[radius, 0]])), theme.ink, 1.2);
    },
  };
  draw[kind]();
  if (kind !== "torsion_spring") anchors.forEach((anchor, index) => Array.isArray(anchor) || drawSymbol(sheet, { kind: "joint", angle: 0 }, way[index], theme));
}

/** A load relative to the largest of its kind: an arrow that leaves its place, or one around it. */
function drawLoad(sheet, kind, at, [fx, fy], theme) {
  const colour = theme.isDark ? "rgb(255, 120, 120)" : "rgb(190, 30, 45)";
  const head = (tip, angle, size) => sheet.shape(around(tip, angle, [[0, 0], [-size, 0.45 * size], [-size, -0.45 * size]]), colour, colour, 1);
  if (kind === "moment") {
    const size = Math.abs(fx);
    if (size < 1e-3) return;
    const [radius, sweep] = [9 + 9 * size, 1.5 * Math.PI * Math.sign(fx)];
    const arc = Array.from({ length: 25 }, (_, index) => (sweep * index) / 24);
    sheet.line(arc.flatMap((angle) => around(at, angle, [[radius, 0]])), colour, 1.8);
    head(around(at, sweep, [[radius, 0]])[0], sweep + (Math.PI / 2) * Math.sign(fx), 8);
    return;
  }
  const size = Math.hypot(fx, fy);
  if (size < 1e-3) return;
  const [length, angle] = [(kind === "line_force" ? 26 : 52) * size, Math.atan2(fy, fx)];
  sheet.line(around(at, angle, [[0, 0], [length, 0]]), colour, kind === "line_force" ? 1.2 : 1.8);
  head(around(at, angle, [[length, 0]])[0], angle, kind === "line_force" ? 6 : 9);
}
