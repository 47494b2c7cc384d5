// Searches a page for `word` and counts its hits in another way: once all parts are open, by the LaTeX of equations and
// by the plain text of all other blocks, which contain `latex` and `text`. Writes what differs to the body.
(() => {
  const D = document.body.dataset, wrong = [];
  const expect = (what, found, wanted) => { if (found !== wanted) wrong.push(`${what}: ${found}, not ${wanted}`); };
  const [field, said] = document.querySelectorAll("[role=search] :is(input, [role=status])");
  const press = (target, key, shiftKey = false) =>
    target.dispatchEvent(new KeyboardEvent("keydown", { key, shiftKey, bubbles: true, cancelable: true }));
  const all = (name) => [...document.querySelectorAll(name)];

  function search() {
    D.found = "";
    press(document.body, "/");
    expect("focus", document.activeElement, field);
    field.value = word;
    press(field, "Enter");
    const total = Number(said.textContent.split(" of ")[1]);
    const folded = all("noscript").length;
    // Each hit is shown: no part around it is folded.
    for (let hit = 1; total >= hit; hit++) {
      expect("count", said.textContent, `${hit} of ${total}`);
      const now = document.querySelector(".found.now");
      if (!now) wrong.push(`hit ${hit} is not marked`);
      else expect(`folded parts around hit ${hit}`, now.parentElement.closest("details:not([open]) > :not(summary)"), null);
      press(field, "Enter");
    }
    expect("after the last hit", said.textContent, `1 of ${total}`);
    press(field, "Enter", true);
    expect("before the first hit", said.textContent, `${total} of ${total}`);
    const opened = folded - all("noscript").length;
    field.value = "no such word";
    press(field, "Enter");
    expect("unknown word", said.textContent, "no hits");
    press(field, "Escape");
    expect("marks after Escape", field.value + said.textContent + all(".found").length, "0");
    for (const details of all("details")) details.open = true;
    setTimeout(() => {
      const blocks = all("h1, h2, h3, p, th, td, caption, summary, figcaption, svg text").filter((block) => !block.closest("[hidden]"));
      const has = (block) => block.dataset.latex === undefined ? text.test(block.textContent) : latex.test(block.dataset.latex);
      expect("hits", total, blocks.filter(has).length);
      D.found = wrong.length > 0 ? wrong.join("; ") : total > 0 ? `right, ${total} hits, ${opened} opened` : "nothing";
    }, 300);
  }
  setTimeout(search, 500);
})();
