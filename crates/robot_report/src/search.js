
"use strict";
(() => {
  // A hit is a block of text or an equation. Folded ones are read without being shown.
  const search = document.querySelector("[role=search]");
  const [field, count] = search.querySelectorAll("input, [role=status]");
  const BLOCKS = "h1, h2, h3, p, th, td, caption, summary, figcaption, text";
  const known = new WeakMap();
  let at, last, timer;

  // As typed on a keyboard: a superscript digit is not an index, and a dotted q is qd, as in code.
  const plain = (text) => text.replace(/[²³¹⁰-⁹]/g, "^").normalize("NFKD")
    .replace(/q\u0307/g, "qd").replace(/q\u0308/g, "qdd").replace(/\u2212/g, "-");

  // Pieces of a formula are apart, except for indices.
  function flat({ childNodes, localName }) {
    const parts = [...childNodes].map((node) => node.data ?? flat(node));
    if (/^msu(p|bsup)$/.test(localName)) parts.splice(-1, 0, "^");
    return plain(parts.join(/^msu/.test(localName) ? "" : " "));
  }
  const textOf = (one) => ({ one, text: flat(one) });
  const bare = (text) => text.trim().replace(/[_^{}\\]/g, "");

  // One or two letters are a symbol, found as a whole; its capitals count unless nothing is found.
  const isSymbol = (key) => /^[A-Za-z]{1,2}\d*$/.test(key);
  const sign = (letter) => /\w/.test(letter) ? letter + "[_^]?" : /\s/.test(letter) ? "\\s*" : `\\s*\\${letter}\\s*`;
  function pattern(key) {
    // An index is not a symbol of its own: x_2 is not in ω_x^2.
    const [before, after] = isSymbol(key) ? ["(^|[^A-Za-z0-9_\\u0300-\\u03ff])", "(?![A-Za-z])"] : ["", ""];
    return before + [...key].map(sign).join("") + (/\d$/.test(key) ? "(?!\\d)" : after);
  }

  // The name of a parameter also finds its symbol.
  function matcher(key, flags) {
    const name = new RegExp(`^${pattern(key)}$`, flags);
    const rows = [...document.querySelectorAll("#parameters tbody tr")].filter(({ cells }) => name.test(flat(cells[0])));
    return new RegExp([key, ...rows.map(({ cells }) => bare(flat(cells[1])))].map(pattern).join("|"), flags);
  }

  const blocks = () => [...document.querySelectorAll(`body > :not(nav) :is(${BLOCKS}), noscript`)].flatMap((one) => {
    if (one.localName !== "noscript") return one.closest("[hidden]") ? [] : textOf(one);
    if (!known.has(one)) {
      const inside = new DOMParser().parseFromString(one.textContent, "text/html").querySelectorAll(BLOCKS);
      known.set(one, [...inside].map((block) => ({ folded: one, text: flat(block) })));
    }
    return known.get(one);
  });

  function open(from) {
    for (let part = from.closest("details"); part; part = part.parentElement.closest("details")) {
      part.open = true;
      // The event unfolds it at once.
      part.dispatchEvent(new Event("toggle"));
    }
  }

  function go(to) {
    last = field.value;
    const key = bare(plain(last));
    let hits = [], wanted;
    for (const flags of isSymbol(key) ? ["", "i"] : ["i"]) {
      if (!key || hits.length > 0) break;
      wanted = matcher(key, flags);
      hits = blocks().filter(({ text }) => wanted.test(text));
    }
    at = (to + hits.length) % hits.length;
    const { one, folded } = hits[at] ?? {};
    if (folded) {
      open(folded);
      if (!folded.isConnected) go(at);
      return;
    }
    // The smallest elements with the text are marked.
    const mark = (element, isNow) => {
      const inside = [...element.children].filter((child) => wanted.test(flat(child)));
      for (const child of inside) mark(child, isNow);
      if (inside.length === 0) element.classList.add("found", ...isNow ? ["now"] : []);
    };
    for (const old of document.querySelectorAll(".found")) old.classList.remove("found", "now");
    for (const hit of hits) if (hit.one) mark(hit.one, hit.one === one);
    search.toggleAttribute("data-on", last !== "");
    count.textContent = !key ? "" : one ? `${at + 1} of ${hits.length}` : "no hits";
    if (one) open(one.localName === "summary" ? one.parentElement.parentElement : one);
    document.querySelector(".now")?.scrollIntoView({ block: "center", inline: "nearest" });
  }

  const step = (by) => { clearTimeout(timer); go(field.value === last ? at + by : 0); };
  field.addEventListener("input", () => { clearTimeout(timer); timer = setTimeout(go, 200, 0); });
  for (const button of search.querySelectorAll("button")) button.addEventListener("click", () => step(Number(button.value)));
  document.addEventListener("keydown", (event) => {
    const { key, target } = event;
    if (target === field) {
      if (key === "Enter") step(event.shiftKey ? -1 : 1);
      if (key === "Escape") { field.value = ""; step(0); }
    } else if (key === "/") {
      if (event.ctrlKey || event.metaKey || event.altKey || target.closest("input")) return;
      event.preventDefault();
      field.focus();
      field.select();
    }
  });
  search.hidden = false;
})();
