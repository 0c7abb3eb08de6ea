// Buttons, keys and pointers, and the start of the page.

const byId = (id) => document.getElementById(id);

/** All that can be done, each with its keys. */
const ACTIONS = [
  { keys: [" "], label: "space", words: "play or pause", run: (viewer) => (viewer.clock.isPlaying = !viewer.clock.isPlaying) },
  { keys: ["ArrowLeft", "ArrowRight"], label: "← →", words: "a frame back, on", run: (viewer, key) => seekFrames(viewer, key === "ArrowLeft" ? -1 : 1) },
  { keys: ["PageUp", "PageDown"], label: "PageUp PageDown", words: "ten frames back, on", run: (viewer, key) => seekFrames(viewer, key === "PageUp" ? -10 : 10) },
  { keys: ["Home", "End"], label: "Home End", words: "the start, the end", run: (viewer, key) => viewer.clock.seek(key === "Home" ? -Infinity : Infinity) },
  { keys: ["ArrowUp"], name: "faster", label: "↑", words: "faster", run: (viewer) => viewer.clock.faster() },
  { keys: ["ArrowDown"], name: "slower", label: "↓", words: "slower", run: (viewer) => viewer.clock.slower() },
  { keys: ["+", "="], name: "closer", label: "+", words: "zoom in", run: (viewer) => viewer.zoom(1.25) },
  { keys: ["-"], name: "farther", label: "−", words: "zoom out", run: (viewer) => viewer.zoom(0.8) },
  { keys: ["0"], name: "whole", label: "0", words: "the whole motion", run: (viewer) => showWhole(viewer) },
  { keys: ["Shift+ArrowLeft", "Shift+ArrowRight", "Shift+ArrowUp", "Shift+ArrowDown"], label: "Shift with arrows", words: "move the view", run: pan },
  { keys: ["f"], switch: "follow", words: "follow the motion" },
  { keys: ["c"], label: "c", words: "the next colouring", run: nextColour },
  { keys: ["t"], switch: "trails", words: "trails" },
  { keys: ["k"], switch: "knots", words: "knots or nodes" },
  { keys: ["s"], switch: "symbols", words: "supports, joints, springs, drives, sliders" },
  { keys: ["l"], switch: "loads", words: "loads" },
  { keys: [..."123456789"], label: "1 … 9", words: "show or hide a simulation, where there are several", run: (viewer, key) => toggleCase(viewer, Number(key) - 1) },
  { keys: ["m"], name: "more", label: "m", words: "more or fewer buttons, on a narrow screen", run: () => byId("bar").classList.toggle("open") },
  { keys: ["?"], name: "help", label: "?", words: "these keys", run: () => (byId("help").open ? byId("help").close() : byId("help").showModal()) },
];

function seekFrames(viewer, count) {
  viewer.clock.isPlaying = false;
  viewer.stepFrames(count);
}

function showWhole(viewer) {
  viewer.switches.follow = false;
  viewer.fit();
}

function pan(viewer, key) {
  viewer.switches.follow = false;
  const [x, y] = { ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] }[key];
  viewer.view.move(x, y);
}

function nextColour(viewer) {
  const names = [null, ...viewer.fieldNames];
  viewer.field = names[(names.indexOf(viewer.field) + 1) % names.length];
}

function toggleCase(viewer, index) {
  const panel = viewer.panels[index];
  if (!panel || viewer.panels.length === 1) return;
  panel.section.hidden = !panel.section.hidden;
  viewer.fit();
}

/** Shows on the page what the viewer is. */
function refresh(viewer) {
  const { clock } = viewer;
  byId("play").textContent = clock.isPlaying ? "⏸" : "▶";
  byId("play").setAttribute("aria-label", clock.isPlaying ? "pause" : "play");
  byId("scrub").value = clock.time;
  const [film] = viewer.shown.map((panel) => panel.film);
  byId("time").textContent = `t = ${shown(film ? film.times[film.frameAt(clock.time)] : clock.time, 5)}`;
  byId("scrub").setAttribute("aria-valuetext", byId("time").textContent);
  byId("rate").textContent = `${shown(clock.rate)} /s`;
  byId("colour").value = viewer.field ?? "";
  for (const button of document.querySelectorAll("[data-switch]")) button.setAttribute("aria-pressed", viewer.switches[button.dataset.switch]);
  viewer.panels.forEach(({ section }, index) => byId("cases").children[index]?.setAttribute("aria-pressed", !section.hidden));
  refreshShades(viewer);
  viewer.draw();
}

/** The bar that says which colour is which value. */
function refreshShades(viewer) {
  const film = viewer.films.find(({ fields }) => fields.some(({ name }) => name === viewer.field));
  byId("shades").hidden = !film;
  if (!film) return;
  const { field, low, high, isSigned } = viewer.shading(film);
  const { unit } = film.fields[field];
  byId("least").textContent = shown(low, 3);
  byId("greatest").textContent = `${shown(high, 3)}${unit && unit !== "-" ? ` [${unit}]` : ""}`;
  const context = byId("ramp").getContext("2d");
  for (let x = 0; x < 64; x++) {
    context.fillStyle = viewer.theme.shade(x / 63, isSigned);
    context.fillRect(x, 0, 1, 1);
  }
}

/** Calls `draw` once before the next picture of the screen, however often it is asked for. */
function once(draw) {
  let isAsked = false;
  return () => {
    if (isAsked) return;
    isAsked = true;
    requestAnimationFrame(() => {
      isAsked = false;
      draw();
    });
  };
}

function connectKeys(viewer, changed) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.("select")) return;
    if (event.target.closest?.("button") && (event.key === " " || event.key === "Enter")) return;
    if (byId("help").open && event.key !== "?") return;
    const key = event.shiftKey && event.key.startsWith("Arrow") ? `Shift+${event.key}` : event.key;
    const action = ACTIONS.find(({ keys }) => keys.includes(key));
    if (!action) return;
    event.preventDefault();
    if (action.switch) viewer.switches[action.switch] = !viewer.switches[action.switch];
    else action.run(viewer, event.key);
    changed();
  });
}

function connectButtons(viewer, changed) {
  const doing = (run) => () => {
    run();
    changed();
  };
  byId("play").onclick = doing(() => ACTIONS[0].run(viewer));
  byId("scrub").oninput = doing(() => {
    viewer.clock.isPlaying = false;
    viewer.clock.seek(Number(byId("scrub").value));
  });
  byId("colour").onchange = doing(() => (viewer.field = byId("colour").value || null));
  for (const button of document.querySelectorAll("[data-do]")) {
    button.onclick = doing(() => ACTIONS.find(({ name }) => name === button.dataset.do).run(viewer));
  }
  for (const button of document.querySelectorAll("[data-switch]")) {
    const name = button.dataset.switch;
    button.onclick = doing(() => (viewer.switches[name] = !viewer.switches[name]));
  }
  viewer.films.forEach((film, index) => {
    const button = Object.assign(document.createElement("button"), { textContent: film.label });
    button.onclick = doing(() => toggleCase(viewer, index));
    byId("cases").append(button);
  });
  byId("cases").hidden = viewer.films.length < 2;
}

/** One finger or the mouse moves the view, two fingers and the wheel zoom. */
function connectStage(viewer, panel, changed) {
  const canvas = panel.stage.sheet.canvas;
  const pointers = new Map();
  const place = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
  };
  canvas.onpointermove = (event) => {
    const now = place(event);
    const before = pointers.get(event.pointerId);
    if (!before) {
      panel.reading.textContent = viewer.read(panel, now);
      return;
    }
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    pointers.set(event.pointerId, now);
    viewer.switches.follow = false;
    if (other) {
      const apart = ([x, y]) => Math.hypot(x - other[0], y - other[1]);
      viewer.zoom(apart(now) / (apart(before) || 1), [(now[0] + other[0]) / 2, (now[1] + other[1]) / 2], panel.stage.size);
    } else {
      viewer.view.move(now[0] - before[0], now[1] - before[1]);
    }
    changed();
  };
  const release = (event) => pointers.delete(event.pointerId);
  Object.assign(canvas, { onpointerup: release, onpointercancel: release });
  canvas.onpointerleave = () => (panel.reading.textContent = "");
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    viewer.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.03 : 0.0015)), place(event), panel.stage.size);
    changed();
  }, { passive: false });
  canvas.ondblclick = () => {
    showWhole(viewer);
    changed();
  };
}

/** A chart is a place to choose the time. */
function connectChart(viewer, chart, changed) {
  const canvas = chart.sheet.canvas;
  const choose = (event) => {
    if (event.buttons === 0) return;
    viewer.clock.isPlaying = false;
    viewer.clock.seek(chart.timeAt(event.clientX - canvas.getBoundingClientRect().left));
    changed();
  };
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    choose(event);
  };
  canvas.onpointermove = choose;
}

function play(viewer) {
  let last = null;
  const pass = (now) => {
    if (viewer.clock.isPlaying) {
      if (last !== null) viewer.clock.pass(Math.min((now - last) / 1000, 0.1));
      refresh(viewer);
    }
    last = viewer.clock.isPlaying ? now : null;
    requestAnimationFrame(pass);
  };
  requestAnimationFrame(pass);
}

function describeKeys(viewer) {
  for (const { keys, label, words } of ACTIONS) {
    const row = byId("keys").insertRow();
    row.insertCell().append(Object.assign(document.createElement("kbd"), { textContent: label ?? keys[0] }));
    row.insertCell().textContent = words;
  }
  byId("exactness").textContent = `Every frame is one that the solver has computed. Places are kept to ±${shown(viewer.exactness, 2)}; zooming in ends where that is a pixel.`;
}

async function start() {
  const trouble = byId("trouble");
  if (typeof DecompressionStream === "undefined") {
    trouble.textContent = "This browser is too old for this page: it needs Chrome 80, Firefox 113 or Safari 16.4, or a later one.";
    return null;
  }
  trouble.textContent = "reading …";
  try {
    const viewer = await Viewer.read(JSON.parse(byId("data").textContent));
    trouble.hidden = true;
    byId("bar").hidden = false;
    Object.assign(byId("scrub"), { min: viewer.clock.start, max: viewer.clock.end });
    for (const name of ["", ...viewer.fieldNames]) byId("colour").append(new Option(name || "beams", name));
    const changed = once(() => refresh(viewer));
    connectKeys(viewer, changed);
    connectButtons(viewer, changed);
    for (const panel of viewer.panels) {
      connectStage(viewer, panel, changed);
      for (const chart of panel.charts) connectChart(viewer, chart, changed);
    }
    describeKeys(viewer);
    // Before the next picture of the screen, so that no canvas is ever stretched.
    const resized = new ResizeObserver(() => {
      // Who has moved the view keeps it, also where a telephone hides its bars.
      if (viewer.view.isFitted) viewer.fit();
      viewer.draw();
    });
    for (const { stage, charts } of viewer.panels) for (const { sheet } of [stage, ...charts]) resized.observe(sheet.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      viewer.theme = new Theme();
      changed();
    });
    viewer.fit();
    refresh(viewer);
    play(viewer);
    return viewer;
  } catch (error) {
    trouble.hidden = false;
    trouble.textContent = `This page cannot be shown: ${error.message}`;
    throw error;
  }
}

/** The viewer, once it is there. */
const viewerReady = start();
