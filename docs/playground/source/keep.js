// Storage of texts in the browser. A page without storage, for example in a private window, still works.

const CURRENT = "withy.text";
const EARLIER = "withy.earlier";
const MOST_EARLIER = 20;

function attempt(action, otherwise) {
  try {
    return action();
  } catch {
    return otherwise;
  }
}

/** Stores the text of the editor for this tab, and for the next visit. */
export function keep(text) {
  return attempt(() => {
    sessionStorage.setItem(CURRENT, text);
    localStorage.setItem(CURRENT, text);
    return true;
  }, false);
}

/** Text of this tab or of the last visit; `null` if there is none. */
export const kept = () => attempt(() => sessionStorage.getItem(CURRENT) ?? localStorage.getItem(CURRENT), null);

/** Earlier texts with their times, newest first. */
export const earlier = () => attempt(() => JSON.parse(localStorage.getItem(EARLIER)) ?? [], []);

/** Stores a text that is about to be replaced in the list of earlier texts. */
export function putAway(text) {
  if (text.trim() === "") return;
  const others = earlier().filter((other) => other.text !== text);
  const list = [{ text, time: Date.now() }, ...others].slice(0, MOST_EARLIER);
  attempt(() => localStorage.setItem(EARLIER, JSON.stringify(list)));
}
