// Prints the scripts of the repository as JSON: folder, name, title and text.
import { readdirSync, readFileSync } from "node:fs";

const root = new URL("../../../", import.meta.url);

function listed(folder) {
  const names = readdirSync(new URL(folder, root)).filter((name) => name.endsWith(".rhai"));
  return names.sort().map((name) => {
    const text = readFileSync(new URL(folder + name, root), "utf8");
    const title = text.split("\n")[0].replace(/^\/\/!?\s*/, "").split(/[:.](\s|$)/)[0];
    return { folder: folder.replace(/\/$/, ""), name, title, text };
  });
}

console.log(JSON.stringify([...listed("scripts/"), ...listed("scripts/gallery/")]));
