//! `withy view`, and its page in a browser, if one is installed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

const SCRIPT: &str = "
let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
let scene = new_scene(\"swing & </script>\");
let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });
scene.hinge(rod.start);
scene.gravity([0, -9.81]);
let sim = scene.start(#{ dt: 0.02 });
for t in [0, 0.5, 1, 1.5] { sim.run_to(t); let p = sim.position(rod.end); print(`${t} ${p.x} ${p.y}`); }
sim.save(\"swing.withy\")";

fn withy(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.args(arguments).current_dir(folder).output().expect("withy starts")
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("swing.rhai"), SCRIPT).expect("the script is written");
    folder
}

#[test]
fn a_script_and_a_saved_simulation_become_the_same_page() {
    let folder = folder();
    let home = folder.path();
    let output = withy(home, &["view", "swing.rhai", "--no-open"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(said(&output).contains("wrote out/swing.html"), "{}", said(&output));
    let of_script = fs::read(home.join("out/swing.html")).expect("a page");
    let output = withy(home, &["view", "out/swing.withy", "--no-open", "-o", "pages/a.html"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(said(&output), "wrote pages/a.html\n");
    assert_eq!(fs::read(home.join("pages/a.html")).expect("a page"), of_script);
    fs::rename(home.join("out/swing.withy"), home.join("alone.withy")).expect("it is moved");
    let output = withy(home, &["view", "alone.withy", "--no-open", "--quiet"]);
    assert_eq!((output.status.code(), said(&output)), (Some(0), String::new()));
    assert!(home.join("alone.html").is_file(), "it is beside the file");
}

#[test]
fn files_that_cannot_be_viewed_are_rejected() {
    let folder = folder();
    let home = folder.path();
    fs::write(home.join("none.rhai"), "print(1)").expect("a script");
    let output = withy(home, &["view", "none.rhai", "--no-open"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("there is no simulation yet"), "{}", said(&output));
    let output = withy(home, &["view", "no.withy", "--no-open"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("there is no file \"no.withy\""), "{}", said(&output));
    let output = withy(home, &["view", "swing.rhai", "--no-open", "--max-steps", "10"]);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(!home.join("out/swing.html").exists());
}

/// Browser that can run headless.
fn browser() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let all = std::env::split_paths(&path).flat_map(|folder| names.map(|name| folder.join(name)));
    all.into_iter().find(|program| program.is_file())
}

/// Adds a script to a page. Returns its result, the text of the element `found`, and the output of the console.
fn asked(browser: &Path, page: &Path, script: &str, options: &[&str]) -> (Value, String) {
    let home = tempfile::tempdir().expect("a temporary folder");
    let added = format!(
        "<script>viewerReady.then(async (viewer) => {{ const found = await (async () => {{ {script} }})();
         const element = document.body.appendChild(document.createElement('pre'));
         element.id = 'found'; element.textContent = JSON.stringify(found); }})</script></body>"
    );
    // A timer replaces animation frames, which a headless browser does not request.
    let clock = "<body><script>window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);</script>";
    let text = fs::read_to_string(page).expect("a page");
    let text = text.replace("<body>", clock).replace("</body>", &added);
    let asking = home.path().join("asking.html");
    fs::write(&asking, text).expect("a page");
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .args(["--force-device-scale-factor=1", "--virtual-time-budget=10000"])
        .args(["--enable-logging=stderr", "--v=0", "--window-size=1000,800", "--dump-dom"])
        .args(options)
        .arg(format!("--user-data-dir={}", home.path().join("profile").display()))
        .arg(format!("file://{}", asking.display()))
        .output()
        .expect("the browser starts");
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let said = said(&output);
    // The remark on repeated pixel reads is caused by the test itself.
    let is_told = |line: &&str| line.contains("CONSOLE") && !line.contains("Multiple readback");
    let console = said.lines().filter(is_told).collect::<Vec<_>>();
    let found = dom.split_once("id=\"found\">").and_then(|(_, rest)| rest.split_once("</pre>"));
    let found = found.unwrap_or_else(|| panic!("the page says nothing: {console:?}\n{dom}")).0;
    let found = found.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    (serde_json::from_str(&found).expect("JSON"), console.join("\n"))
}

/// In the width of a phone the page is not cut off, and rarely used controls are behind a button.
#[test]
fn viewer_page_fits_narrow_windows() {
    let Some(browser) = browser() else { return };
    let folder = folder();
    let output = withy(folder.path(), &["view", "swing.rhai", "--no-open"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let script = "const shown = (name) => getComputedStyle(document.querySelector(name)).display !== 'none';
         return { wide: document.documentElement.scrollWidth, inner: innerWidth, more: shown('#more'), wrap: shown('footer .wrap') };";
    let page = folder.path().join("out/swing.html");
    for size in ["--window-size=500,900", "--window-size=900,450"] {
        let (found, console) = asked(&browser, &page, script, &[size]);
        assert_eq!(console, "", "the console is silent");
        assert!(found["inner"].as_f64().is_some_and(|inner| inner < 1000.0), "{found}");
        assert!(found["wide"].as_f64() <= found["inner"].as_f64(), "nothing is cut: {found}");
        assert_eq!((&found["more"], &found["wrap"]), (&true.into(), &false.into()), "{found}");
    }
}

#[test]
fn displayed_tip_position_agrees_with_the_solver() {
    let Some(browser) = browser() else {
        let is_wanted = std::env::var_os("WITHY_BROWSER").is_some();
        assert!(!is_wanted, "WITHY_BROWSER is set, and there is no chromium");
        eprintln!("skipped: there is no chromium, so the viewer is not opened in a browser");
        return;
    };
    let folder = folder();
    let output = withy(folder.path(), &["view", "swing.rhai", "--no-open"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let printed = String::from_utf8(output.stdout).expect("text");
    let tips: Vec<Vec<f64>> = printed
        .lines()
        .map(|line| line.split(' ').map(|number| number.parse().expect("a number")).collect())
        .collect();
    assert_eq!(tips.len(), 4);
    // Plays the motion. Then, at each time, reads a pixel at the tip position of the solver, and one 4 pixels beyond it along the beam.
    let script = format!(
        "document.dispatchEvent(new KeyboardEvent('keydown', {{ key: ' ' }}));
         await new Promise((done) => setTimeout(done, 1000));
         const played = viewer.clock.time;
         document.dispatchEvent(new KeyboardEvent('keydown', {{ key: ' ' }}));
         Object.assign(viewer.switches, {{ trails: false, knots: false, symbols: false, loads: false }});
         const {{ film, stage }} = viewer.panels[0];
         const pixel = ([x, y]) => [...stage.sheet.context.getImageData(Math.floor(x), Math.floor(y), 1, 1).data];
         const frames = {tips:?}.map(([time, x, y]) => {{
           viewer.clock.seek(time);
           refresh(viewer);
           const {{ centre, scale }} = viewer.view;
           const {{ width, height }} = stage.size;
           const [px, py] = [width / 2 + (x - centre[0]) * scale, height / 2 - (y - centre[1]) * scale];
           const far = Math.hypot(x, y) * scale;
           const beyond = [px + 4 * x * scale / far, py - 4 * y * scale / far];
           const line = film.line(film.beams[0], film.frameAt(time));
           const tip = viewer.view.toScreen(line[line.length - 1], stage.size);
           return {{ off: Math.hypot(tip[0] - px, tip[1] - py), at: pixel([px, py]), beyond: pixel(beyond), scale,
                     inside: px > 0 && py > 0 && px < width && py < height }};
         }});
         return {{ played, frames, hidden: document.getElementById('trouble').hidden, title: document.title,
                   heading: document.querySelector('h1').textContent, wide: document.documentElement.scrollWidth }};"
    );
    let page = folder.path().join("out/swing.html");
    for (options, paper) in [(&[][..], 255), (&["--blink-settings=preferredColorScheme=0"][..], 22)]
    {
        let (found, console) = asked(&browser, &page, &script, options);
        assert_eq!(console, "", "the console is silent");
        assert_eq!(found["hidden"], true);
        assert_eq!(found["title"], "swing & </script>");
        assert_eq!(found["heading"], "swing & </script>");
        assert!(
            found["wide"].as_f64().is_some_and(|wide| wide <= 1000.0),
            "nothing is cut: {found}"
        );
        assert!(found["played"].as_f64().is_some_and(|time| time > 0.0), "it plays: {found}");
        for frame in found["frames"].as_array().expect("frames") {
            let red = |name: &str| frame[name][0].as_u64().expect("a part of a colour");
            assert!(frame["off"].as_f64().is_some_and(|off| off < 0.5), "{frame}");
            assert!(frame["scale"].as_f64().is_some_and(|scale| scale > 50.0), "{frame}");
            assert_eq!(frame["inside"], true);
            assert!(
                red("beyond").abs_diff(paper) < 30,
                "beyond the tip is paper, or a line of the grid: {frame}"
            );
            assert!(red("at").abs_diff(paper) > 40, "at the tip is the rod: {frame}");
        }
    }
}
