
"use strict";
(() => {
  // A page beside a picture whose width and height tell which page is the newest. A page opened from a
  // file may load pictures, and nothing else that tells of a change.
  const page = document.documentElement.dataset.page;
  const stamp = location.href.replace(/[?#].*$/, "") + ".svg?";
  const kept = history.state;
  const panels = () => [...document.querySelectorAll("details")];
  let seen = false;

  if (kept?.open) {
    panels().forEach((panel, place) => { panel.open = kept.open.includes(place); });
    scrollTo(0, kept.top);
  }

  // The browser keeps the place of a page that has no script as this.
  function reload(restoration) {
    const open = [...panels().entries()].filter(([, panel]) => panel.open).map(([place]) => place);
    history.scrollRestoration = restoration;
    history.replaceState({ open, top: scrollY }, "");
    location.reload();
  }

  function look() {
    const picture = new Image();
    picture.onload = () => {
      seen = true;
      if (`${picture.naturalWidth} ${picture.naturalHeight}` === page) setTimeout(look, 250);
      else reload("manual");
    };
    // The picture goes when the file is watched no longer.
    picture.onerror = () => { if (seen) reload("auto"); else setTimeout(look, 2000); };
    picture.src = stamp + Date.now();
  }
  look();
})();
