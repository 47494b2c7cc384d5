
"use strict";
(() => {
  // What shows a link or a parameter bears its token in data-is, what depends on some in data-of.
  let pinned = null;

  function tokens(element) {
    const words = (element.dataset.is || "") + " " + (element.dataset.of || "");
    return words.split(" ").filter((word) => word);
  }

  // The summary of the folded part that has what bears a token.
  function showFolded(token) {
    for (const folded of document.querySelectorAll("details > noscript")) {
      if (folded.textContent.includes(` data-is="${token}"`)) {
        folded.parentElement.querySelector("summary").classList.add("lit");
      }
    }
  }

  function show(element) {
    for (const lit of document.querySelectorAll(".lit, .chosen")) lit.classList.remove("lit", "chosen");
    if (!element) return;
    // A term lights what it depends on; a link or a parameter lights all that depends on it.
    const isTerm = element.dataset.is === undefined;
    for (const token of tokens(element)) {
      const name = CSS.escape(token);
      const bearers = `[data-is~=${name}]` + (isTerm ? "" : `, [data-of~=${name}]`);
      const found = document.querySelectorAll(bearers);
      for (const other of found) other.classList.add("lit");
      if (found.length === 0) showFolded(token);
    }
    element.classList.add("chosen");
  }

  // What is folded is text in noscript elements; opened, it becomes a part of the page.
  function unfold(details) {
    for (const folded of details.querySelectorAll(":scope > noscript")) {
      const part = document.createRange();
      part.selectNode(folded);
      folded.replaceWith(part.createContextualFragment(folded.textContent));
    }
  }

  // Opens what an address leads to.
  function follow() {
    const id = decodeURIComponent(location.hash.slice(1));
    if (!id) return;
    if (!document.getElementById(id)) {
      for (const folded of document.querySelectorAll("details > noscript")) {
        if (folded.textContent.includes(` id="${id}"`)) { unfold(folded.parentElement); break; }
      }
    }
    const target = document.getElementById(id);
    if (!target) return;
    for (let at = target.closest("details"); at; at = at.parentElement.closest("details")) {
      unfold(at);
      at.open = true;
    }
    target.scrollIntoView({ block: "center" });
    if (target.matches("[data-terms]")) {
      show(target);
      offer(target);
    }
  }

  // The tools of one equation at a time.
  const tools = document.createElement("div");
  tools.className = "tools";
  tools.setAttribute("role", "group");
  const said = document.createElement("span");
  said.setAttribute("role", "status");
  const address = (equation) => location.href.split("#")[0] + "#" + equation.id;
  const copies = {
    "LaTeX": (equation) => equation.dataset.latex,
    "Typst": (equation) => "$ " + equation.dataset.typst + " $",
    "MathML": mathml,
    "Link": address,
  };
  for (const [name, text] of Object.entries(copies)) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = name;
    button.title = name === "Link" ? "Copy a link to this equation" : `Copy this equation as ${name}`;
    button.addEventListener("click", (event) => {
      event.stopPropagation();
      const equation = tools.previousElementSibling;
      if (name === "Link") history.replaceState(null, "", "#" + equation.id);
      copy(text(equation), button).then((done) => { said.textContent = done ? "copied" : "not copied"; });
    });
    tools.append(button);
  }
  tools.append(said);

  function mathml(equation) {
    const whole = document.createElementNS("http://www.w3.org/1998/Math/MathML", "math");
    whole.setAttribute("display", "block");
    for (const piece of equation.querySelectorAll("math")) {
      for (const part of piece.cloneNode(true).childNodes) whole.append(part.cloneNode(true));
    }
    for (const part of whole.querySelectorAll("*")) {
      for (const name of ["class", "data-of", "tabindex"]) part.removeAttribute(name);
    }
    return new XMLSerializer().serializeToString(whole);
  }

  async function copy(text, button) {
    try {
      await navigator.clipboard.writeText(text);
      return true;
    } catch {
      // Where the page has no clipboard of its own.
      const field = document.createElement("textarea");
      field.value = text;
      document.body.append(field);
      field.select();
      const done = document.execCommand("copy");
      field.remove();
      button.focus();
      return done;
    }
  }

  function offer(equation) {
    if (!equation) return;
    if (tools.previousElementSibling === equation) return;
    said.textContent = "";
    tools.setAttribute("aria-label", `Copy equation ${equation.id}`);
    equation.after(tools);
  }

  const about = (event) => event.target.closest("[data-is], [data-of]");
  const tool = (event) => event.target.closest(".tools");
  document.addEventListener("toggle", (event) => { if (event.target.open) unfold(event.target); }, true);
  document.addEventListener("pointerover", (event) => {
    if (tool(event)) return;
    const equation = event.target.closest("[data-terms]");
    // Tools that have the focus stay where they are.
    if (!tools.contains(document.activeElement)) offer(equation);
    if (!pinned) show(about(event));
  });
  document.addEventListener("focusin", (event) => {
    if (tool(event)) return;
    const equation = event.target.closest("[data-terms]");
    offer(equation);
    if (!pinned) show(about(event));
  });
  document.addEventListener("focusout", () => { if (!pinned) show(null); });
  document.addEventListener("click", (event) => {
    if (tool(event)) return;
    const chosen = about(event);
    pinned = chosen === pinned ? null : chosen;
    show(chosen);
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") { pinned = null; show(null); tools.remove(); }
    if (tool(event)) return;
    const chosen = about(event);
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
  window.addEventListener("hashchange", follow);
  follow();
  document.body.dataset.ready = "";
})();
