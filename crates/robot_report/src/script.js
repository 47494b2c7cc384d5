
"use strict";
(() => {
  // What shows a link or a parameter bears its token in data-is, what depends on some in data-of.
  const marked = new Map();
  for (const element of document.querySelectorAll("[data-is], [data-of]")) {
    for (const token of tokens(element)) {
      if (!marked.has(token)) marked.set(token, []);
      marked.get(token).push(element);
    }
  }
  let pinned = null;

  function tokens(element) {
    const words = (element.dataset.is || "") + " " + (element.dataset.of || "");
    return words.split(" ").filter((word) => word);
  }

  function show(element) {
    for (const lit of document.querySelectorAll(".lit, .chosen")) lit.classList.remove("lit", "chosen");
    if (!element) return;
    // A term lights what it depends on; a link or a parameter lights all that depends on it.
    const isTerm = element.dataset.is === undefined;
    for (const token of tokens(element)) {
      for (const other of marked.get(token) || []) {
        if (!isTerm || other.dataset.is !== undefined) other.classList.add("lit");
      }
    }
    element.classList.add("chosen");
  }

  const about = (event) => event.target.closest("[data-is], [data-of]");
  document.addEventListener("pointerover", (event) => { if (!pinned) show(about(event)); });
  document.addEventListener("focusin", (event) => { if (!pinned) show(about(event)); });
  document.addEventListener("focusout", () => { if (!pinned) show(null); });
  document.addEventListener("click", (event) => {
    const chosen = about(event);
    pinned = chosen === pinned ? null : chosen;
    show(chosen);
  });
  document.addEventListener("keydown", (event) => {
    const chosen = about(event);
    if (event.key === "Escape") { pinned = null; show(null); }
    if (!chosen) return;
    if (event.key === "Enter") { pinned = chosen === pinned ? null : chosen; show(chosen); }
    // One stop of the tabulator for each formula; the arrows go through its terms.
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    const formula = chosen.closest("[data-terms]");
    if (!step || !formula) return;
    const terms = [...formula.querySelectorAll("[data-of][tabindex]")];
    const next = terms[terms.indexOf(chosen) + step];
    if (!next) return;
    event.preventDefault();
    chosen.setAttribute("tabindex", "-1");
    next.setAttribute("tabindex", "0");
    pinned = null;
    next.focus();
  });
  document.body.dataset.ready = "";
})();
