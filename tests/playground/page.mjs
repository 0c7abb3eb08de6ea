// Test of the page in Chromium: node page.mjs MODULES NATIVE [SCREENSHOTS]. MODULES is a folder node_modules with playwright-core and axe-core.
// NATIVE has a folder of files for each script, written by `withy run`. Needs what docs/playground/build creates.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join, resolve } from "node:path";

const [modules, native, screenshots] = process.argv.slice(2);
const { chromium } = createRequire(join(resolve(modules), "x"))("playwright-core");
const axe = readFileSync(join(modules, "axe-core", "axe.min.js"), "utf8");
const root = new URL("../../docs/playground/", import.meta.url).pathname;
const scripts = new URL("../../scripts/", import.meta.url);

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".wasm": "application/wasm" };
const server = createServer((request, answer) => {
  const name = new URL(request.url, "http://a").pathname.replace(/\/$/, "/index.html");
  try {
    const content = readFileSync(join(root, name));
    answer.writeHead(200, { "content-type": TYPES[extname(name)] }).end(content);
  } catch {
    answer.writeHead(404).end();
  }
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const address = `http://127.0.0.1:${server.address().port}/`;
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });

/** Opens the page in a new profile. Errors of the console are collected. */
async function open(options = {}, fragment = "") {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(String(error)));
  page.on("console", (message) => message.type() === "error" && page.problems.push(message.text()));
  await page.goto(address + fragment);
  await page.locator("#status").getByText("ready").waitFor();
  return page;
}

async function write(page, text) {
  await page.locator(".cm-content").click();
  await page.keyboard.press("ControlOrMeta+a");
  await page.keyboard.insertText(text);
}

const text = (page, id) => page.locator(id).textContent();

/** Runs a script until its end and returns the printed text. */
async function run(page, script, seconds = 120) {
  await write(page, script);
  await page.evaluate(() => (document.getElementById("status").textContent = ""));
  await page.keyboard.press("ControlOrMeta+Enter");
  await page.locator("#status").getByText(/^(finished|ended)/).waitFor({ timeout: 1000 * seconds });
  return text(page, "#printed");
}

const shot = (page, name) => screenshots && page.screenshot({ path: join(screenshots, `${name}.png`) });

async function close(page) {
  assert.deepEqual(page.problems, []);
  await page.context().close();
}

/** Content of a file that the page offers for download. */
async function download(page, name) {
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", { name, exact: true }).click()]);
  return readFileSync(await file.path());
}

const tests = {
  async "the first script runs without network after the page has loaded"() {
    const page = await open();
    await page.context().setOffline(true);
    await page.locator("#run").click();
    await page.locator("#status").getByText("finished").waitFor();
    assert.match(await text(page, "#printed"), /released at t = 0\.7999/);
    const viewer = page.frameLocator("iframe[title='Viewer bead.html']");
    await viewer.locator("canvas, svg").first().waitFor();
    await page.getByAltText("Picture moment.svg").waitFor();
    await shot(page, "first");
    await page.context().setOffline(false);
    await close(page);
  },

  async "files are those of withy"() {
    const page = await open();
    const names = readdirSync(native);
    assert.ok(names.length > 2, "no files to compare with");
    for (const name of names) {
      await run(page, readFileSync(new URL(`${name}.rhai`, scripts), "utf8"));
      const expected = readdirSync(join(native, name)).filter((file) => !file.startsWith("."));
      assert.ok(expected.length > 0, name);
      for (const file of expected) {
        const own = await download(page, file);
        assert.ok(own.equals(readFileSync(join(native, name, file))), `${name}: ${file}`);
      }
      await shot(page, name);
    }
    await close(page);
  },

  async "an error is shown at its line"() {
    const page = await open();
    assert.match(await run(page, "let a = 1;\nlet s = section(#{EAA: 1, GA: 1});\n"), /unknown option 'EAA'/);
    assert.equal(await page.locator(".cm-line").nth(1).locator(".cm-lintRange-error").count(), 1);
    await write(page, "print(1);\nprint(undefined_name);\n");
    await page.locator(".cm-line").nth(1).locator(".cm-lintRange-error").waitFor();
    await page.locator(".cm-lintRange-error").hover();
    await page.locator(".cm-tooltip-lint").getByText("undefined_name").waitFor();
    await shot(page, "error");
    await close(page);
  },

  async "endless loops are stopped by the button and by the limit"() {
    const page = await open();
    await write(page, 'print("begun"); loop { }');
    await page.keyboard.press("ControlOrMeta+Enter");
    await page.locator("#printed").getByText("begun").waitFor();
    await page.locator("#stop").click();
    await page.locator("#printed").getByText("stopped").waitFor();
    await write(page, `${await text(page, "#first-script")}\nloop { }`);
    await page.keyboard.press("ControlOrMeta+Enter");
    await page.getByAltText("Picture moment.svg").waitFor();
    await page.locator("#stop").click();
    assert.match((await download(page, "moment.svg")).toString(), /^<svg[^]*<\/svg>\s*$/);
    await page.locator("#limit").fill("1");
    assert.match(await run(page, "loop { }"), /the time limit was reached/);
    assert.equal(await run(page, "print(6 * 7);"), "42\n");
    await close(page);
  },

  async "too deep, too large and too much end in words"() {
    const page = await open();
    assert.match(await run(page, "fn f(n) { 1 + f(n + 1) }\nprint(f(0));"), /too deeply/);
    assert.match(await run(page, "let a = []; for i in 0..200000 { a = [a]; }\nprint(a.len());"), /nested too deeply|^1\n/);
    const large = "let all = []; loop { let a = []; a.pad(1000000, 1.5); all.push(a); }";
    assert.match(await run(page, large), /the script needs more memory/);
    const many = await run(page, "for i in 0..100000 { print(i); }");
    assert.ok(many.includes("\n99999\n") && many.startsWith("0\n1\n"), many.slice(-100));
    const endless = await run(page, "for i in 0..1000000 { print(i); }\nlet a = unknown_name;");
    assert.match(endless, /the rest of the text is not shown[^]*unknown_name/);
    assert.equal(await run(page, "print(6 * 7);"), "42\n");
    await close(page);
  },

  async "texts are kept and fit into a link"() {
    const page = await open();
    const script = 'print("äß€𝛼"); // kept\n';
    await run(page, script);
    await page.reload();
    await page.locator("#status").getByText("ready").waitFor();
    assert.match(await text(page, ".cm-content"), /äß€𝛼/);
    await page.locator("#link").click();
    await page.waitForFunction(() => location.hash.startsWith("#script="));
    const other = await open({}, new URL(page.url()).hash);
    assert.match(await text(other, ".cm-content"), /äß€𝛼.*kept/);
    await other.locator("#scripts").selectOption("scripts/pendulum.rhai");
    assert.match(await text(other, ".cm-content"), /flexible pendulum/);
    await other.locator("#scripts").selectOption("earlier 0");
    assert.match(await text(other, ".cm-content"), /äß€𝛼/);
    await other.goto(address + "#script=damaged");
    await other.locator("#status").getByText("the link is damaged").waitFor();
    await close(other);
    await close(page);
  },

  async "names and options are completed, and hints are shown"() {
    const page = await open();
    await write(page, 'let scene = new_scene("ä");\n');
    await page.keyboard.press("ControlOrMeta+End");
    await page.keyboard.type("scene.cl");
    await page.locator(".cm-tooltip-autocomplete").getByText("clamp(").first().waitFor();
    await shot(page, "completion");
    await page.keyboard.press("Escape");
    await page.locator(".cm-lintRange-error").first().waitFor();
    assert.equal(await text(page, "#hint"), "");
    await page.getByText("new_scene").hover();
    await page.locator(".help").getByText("new_scene(").first().waitFor();
    await shot(page, "help");
    await write(page, "let s = section(");
    await page.locator("#hint").getByText("section").waitFor();
    await close(page);
  },

  async "the page can be used with the keyboard, on a phone and in the dark"() {
    const page = await open({ viewport: { width: 390, height: 780 }, colorScheme: "dark", hasTouch: true, isMobile: true });
    await page.locator("#run").focus();
    await page.keyboard.press("Enter");
    await page.locator("#status").getByText("finished").waitFor();
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= 390, `the page is ${width} wide`);
    await shot(page, "phone");
    await page.locator("#pictures").scrollIntoViewIfNeeded();
    await shot(page, "phone_results");
    await close(page);
    const desk = await open({ colorScheme: "dark" });
    await run(desk, 'let a = section(#{ EA: 1, GA: "b" }); // dark\nfn f(x) { x.len() + PI }');
    await shot(desk, "dark");
    await desk.locator(".cm-content").click();
    await desk.keyboard.press("Tab");
    assert.equal(await desk.evaluate(() => document.activeElement.closest(".cm-editor")), null);
    await close(desk);
  },

  async "axe finds no violations"() {
    for (const colorScheme of ["light", "dark"]) {
      const page = await open({ colorScheme });
      await page.locator("#run").click();
      await page.locator("#status").getByText("finished").waitFor();
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => globalThis.axe.run({ exclude: ["iframe"] }));
      const found = violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(" ")}`);
      assert.deepEqual(found, [], colorScheme);
      await close(page);
    }
  },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test();
    console.log(`ok: ${name}`);
  } catch (error) {
    failed += 1;
    console.log(`FAILED: ${name}\n${error.stack}`);
  }
}
await browser.close();
server.close();
process.exit(failed > 0 ? 1 : 0);
