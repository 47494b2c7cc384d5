"use strict";
(() => {
  const section = document.getElementById("live");
  const robot = JSON.parse(section.dataset.robot);
  const n = robot.coordinates.length;
  const find = (name) => [...section.querySelectorAll(name)];

  // The functions of the robot, over arrays in the module's own memory.
  function functions(exports) {
    let free = exports.heap_base.value;
    const places = {};
    const array = (name, count) => { places[name] = [free, count]; free += 8 * count; };
    array("q", n); array("qd", n); array("qdd", n);
    array("rotation", 9 * robot.links.length); array("position", 3 * robot.links.length);
    array("M", n * n); array("gravity", n); array("bias", n); array("tau", n); array("rubbing", n);
    array("parameters", robot.parameters.length); array("model", robot.fields);
    const missing = free - exports.memory.buffer.byteLength;
    if (missing > 0) exports.memory.grow(Math.ceil(missing / 65536));
    const values = {};
    for (const [name, [place, count]] of Object.entries(places)) values[name] = new Float64Array(exports.memory.buffer, place, count);
    const call = (name, ...arrays) => {
      const model = robot.parameters.length > 0 ? ["model"] : [];
      exports[name](...[...model, ...arrays].map((array) => places[array][0]));
    };
    values.parameters.set(robot.parameters);
    const configure = () => { if (robot.parameters.length > 0) exports.create_model(places.model[0], places.parameters[0]); };
    const move = () => call("forward_kinematics", "q", "rotation", "position");
    const compute = () => {
      call("mass_matrix", "q", "M");
      call("gravity", "q", "gravity");
      call("bias", "q", "qd", "bias");
      call("inverse_dynamics", "q", "qd", "qdd", "tau");
      if (robot.friction) call("inverse_dynamics_friction", "q", "qd", "qdd", "rubbing");
    };
    configure();
    return { values, configure, move, compute };
  }

  // Numbers of a table: with the same places behind the point, or with significant digits of their own.
  const exact = (value) => Object.is(value, -0) ? "-0" : String(value);
  const magnitude = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  function aligned(values) {
    const largest = magnitude(values);
    const places = largest > 0 ? Math.min(8, Math.max(0, 3 - Math.floor(Math.log10(largest)))) : 0;
    return (value) => value.toFixed(places);
  }
  // The units of the entries differ, and so do their sizes; what is left of a sum by rounding is 0.
  function significant(values) {
    const noise = 1e-13 * magnitude(values);
    return (value) => {
      const size = Math.abs(value);
      if (noise >= size) return "0";
      if (1e-4 > size || size >= 1e6) return value.toExponential(2);
      return value.toFixed(Math.max(0, 2 - Math.floor(Math.log10(size))));
    };
  }
  function show(cells, values, format) {
    values.forEach((value, i) => {
      const cell = cells[i], text = exact(value);
      if (cell.dataset.value !== text) cell.dataset.value = text;
      const digits = format(value);
      const shown = (Number(digits) === 0 ? digits.replace("-", "") : digits).replaceAll("-", "\u2212");
      if (cell.firstChild.data !== shown) cell.firstChild.data = shown;
    });
  }

  // Some browsers round `valueAsNumber`.
  const sliders = ["q", "qd", "qdd"].map((name) => find(`input[data-state=${name}]`));
  const payload = find("input[data-parameter]");
  const told = (slider) => {
    const places = Math.max(2, 1 - Math.floor(Math.log10(slider.max - slider.min)));
    slider.nextElementSibling.firstChild.data = Number(slider.value).toFixed(places).replace("-", "\u2212");
  };

  // Joint torques by cause.
  const causes = find("table.torques tbody tr").map((row) => [...row.querySelectorAll("[data-cause]")]);
  const bars = find("svg.bars").map((svg) => [...svg.querySelectorAll("path")]);
  // Bars of the same unit have the same scale, so that they can be compared.
  const reach = Object.fromEntries(robot.coordinates.map(({ unit }) => [unit, 1e-9]));
  const stated = section.querySelector(".scale");
  const entries = find("table.mass td");
  const contributions = (values, i) => {
    let inertia = 0;
    for (let j = 0; n > j; j++) inertia += values.M[i * n + j] * values.qdd[j];
    const parts = [inertia, values.bias[i] - values.gravity[i], values.gravity[i]];
    if (robot.friction) parts.push(values.rubbing[i] - values.tau[i]);
    return [robot.friction ? values.rubbing[i] : values.tau[i], ...parts];
  };
  function torques(values) {
    const rows = causes.map((_, i) => contributions(values, i));
    show(causes.flat(), rows.flat(), aligned(rows.flat()));
    rows.forEach((row, i) => {
      const { unit } = robot.coordinates[i];
      reach[unit] = Math.max(reach[unit], ...row.map(Math.abs));
    });
    const ends = Object.entries(reach).filter(([, most]) => most > 1e-9);
    const shown = ends.map(([unit, most]) => `\u00b1${Number(most.toPrecision(3))} ${unit}`).join(", ");
    if (stated.textContent !== shown) stated.textContent = shown;
    rows.forEach((row, i) => {
      row.forEach((value, k) => {
        const x = (100 * value / reach[robot.coordinates[i].unit]).toFixed(1);
        const y = 3 + 6 * (k - 1);
        bars[i][k].setAttribute("d", k === 0 ? `M${x} 0V${6 * row.length - 6}` : `M0 ${y}H${x}`);
      });
    });
    const matrix = [...values.M];
    show(entries, matrix, significant(matrix));
    const most = magnitude(matrix);
    entries.forEach((cell, k) => {
      const part = Math.abs(values.M[k]) / most;
      const shade = part > 0 ? "shade-" + Math.min(5, Math.floor(6 * Math.sqrt(part))) : "zero";
      if (cell.className !== shade) cell.className = shade;
    });
  }

  // The scheme. Vectors are arrays; the axes of the view are in the base frame.
  const plus = (a, b, by = 1) => a.map((x, i) => x + by * b[i]);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const svg = section.querySelector("svg.scheme");
  const [WIDTH, HEIGHT] = [640, 440];
  const FIRST = [28, 20];
  let angles = [...FIRST], zoom = 1, axes = [], center = [0, 0, 0], extent = 1e-6;
  function look() {
    const [[sa, ca], [se, ce]] = angles.map((degrees) => [Math.sin(degrees * Math.PI / 180), Math.cos(degrees * Math.PI / 180)]);
    const { up, front } = robot;
    const side = cross(up, front);
    const forth = plus(front.map((x) => x * ca), side, sa);
    axes = [plus(side.map((x) => x * ca), front, -sa), plus(up.map((x) => x * ce), forth, -se), plus(forth.map((x) => x * ce), up, se)];
  }
  const turned = (vector) => [dot(vector, axes[0]), -dot(vector, axes[1])];
  const scale = () => zoom * 0.37 * HEIGHT / extent;
  function project(point) {
    const [x, y] = turned(plus(point, center, -1));
    return [WIDTH / 2 + x * scale(), HEIGHT / 2 + y * scale()];
  }
  const at = ([x, y]) => x.toFixed(1) + " " + y.toFixed(1);
  const line = (points) => "M" + points.map(at).join("L");
  const make = (name, classes, parent) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    made.setAttribute("class", classes);
    parent.append(made);
    return made;
  };
  const BASE = { R: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], p: [0, 0, 0] };
  const column = (R, k) => R.map((row) => row[k]);
  const point = (pose, vector) => plus(pose.p, pose.R.map((row) => dot(row, vector)));
  const poses = (values) => robot.links.map((_, i) => {
    const R = [0, 3, 6].map((k) => [...values.rotation.subarray(9 * i + k, 9 * i + k + 3)]);
    return { R, p: [...values.position.subarray(3 * i, 3 * i + 3)] };
  });

  // Each piece draws itself and gives its depth.
  const hue = (link) => link === null ? "ground" : "hue-" + link % 8;
  const group = make("g", "", svg), labels = make("g", "", svg);
  const ground = make("path", "ground", group);
  function body(path, carrier, link) {
    const own = make("g", hue(carrier), group);
    const drawn = make("path", "body", own);
    const rail = link === null ? null : make("path", "apart", own);
    return { own, draw: (all) => {
      const pose = carrier === null ? BASE : all[carrier];
      const points = path.map((vector) => point(pose, vector));
      drawn.setAttribute("d", line(points.map(project)));
      if (rail) rail.setAttribute("d", line([points[points.length - 1], all[link].p].map(project)));
      return (dot(points[0], axes[2]) + dot(points[points.length - 1], axes[2])) / 2;
    } };
  }
  const [RADIUS, HALF] = [9, 15];
  function cylinder(x, along, near) {
    const length = Math.hypot(...along);
    const [c, s] = length > 1e-9 ? [along[0] / length, along[1] / length] : [1, 0];
    const put = (a, b) => at([x[0] + a * c - b * s, x[1] + a * s + b * c]);
    const half = HALF * length, degrees = (Math.atan2(s, c) * 180 / Math.PI).toFixed(1);
    const arc = `A${(RADIUS * Math.abs(near)).toFixed(1)} ${RADIUS} ${degrees} 0 1 `;
    const end = near > 0 ? half : -half;
    return `M${put(-half, -RADIUS)}L${put(half, -RADIUS)}${arc}${put(half, RADIUS)}L${put(-half, RADIUS)}${arc}${put(-half, -RADIUS)}Z` +
      `M${put(end, -RADIUS)}${arc}${put(end, RADIUS)}${arc}${put(end, -RADIUS)}`;
  }
  function box(x, R, axis) {
    const place = (vector) => plus(x, turned(vector));
    const least = [0, 1, 2].sort((a, b) => Math.abs(dot(column(R, a), axis)) - Math.abs(dot(column(R, b), axis)))[0];
    const across = cross(axis, column(R, least));
    const half = [axis.map((v) => v * HALF), across.map((v) => v * RADIUS), cross(axis, across).map((v) => v * RADIUS)];
    return half.map((normal, k) => {
      const middle = normal.map((v) => v * (dot(normal, axes[2]) > 0 ? 1 : -1));
      const [u, v] = [half[(k + 1) % 3], half[(k + 2) % 3]];
      const corners = [[1, 1], [1, -1], [-1, -1], [-1, 1]].map(([a, b]) => place(plus(plus(middle, u, a), v, b)));
      return line(corners) + "Z";
    }).join("");
  }
  // Moves a label off those that are placed already.
  const STEPS = [[0, 0], [0, 15], [0, -15], [22, 0], [22, 15], [22, -15], [0, 30], [0, -30], [22, 30], [22, -30]];
  let places = [];
  function free(x) {
    const isFree = (step) => places.every((place) => Math.abs(place[0] - x[0] - step[0]) > 20 || Math.abs(place[1] - x[1] - step[1]) > 13);
    const place = plus(x, STEPS.find(isFree) ?? [0, 0]);
    places.push(place);
    return place;
  }
  function joint(link, i) {
    const own = make("g", hue(i), group);
    const axis = make("path", "", make("g", "axis", own));
    const sign = make("path", "", make("g", "joint", own));
    const label = make("text", "", make("g", `coordinate ${hue(i)}`, labels));
    label.textContent = robot.coordinates[link.coordinate].symbol;
    return { own, draw: (all) => {
      const { R, p } = all[i];
      const direction = R.map((row) => dot(row, link.axis));
      const x = project(p), along = turned(direction);
      axis.setAttribute("d", line([plus(x, along, -30), plus(x, along, 40)]));
      sign.setAttribute("d", link.kind === "revolute" ? cylinder(x, along, dot(direction, axes[2])) : box(x, R, direction));
      // Beside a joint whose axis is upright or points at the viewer, where links would cover a label at its end.
      const beside = 0.5 > Math.abs(along[0]) || Math.abs(along[1]) > Math.abs(along[0]);
      const [a, b] = free(beside ? plus(x, [RADIUS + 7, 0]) : plus(x, along, 52));
      label.setAttribute("text-anchor", beside ? "start" : "middle");
      label.setAttribute("x", a.toFixed(1));
      label.setAttribute("y", (b + 4).toFixed(1));
      return dot(p, axes[2]);
    } };
  }
  function triad(own, draw) {
    const arms = [0, 1, 2].map((k) => make("path", "axis-" + "xyz"[k], own));
    return { own, draw: (all) => {
      const { x, R, length, depth } = draw(all);
      arms.forEach((arm, k) => arm.setAttribute("d", line([x, plus(x, turned(column(R, k)), length)])));
      return depth;
    } };
  }
  const pieces = [
    ...robot.links.map((link, i) => body(link.path, link.parent, link.kind === "prismatic" ? i : null)),
    ...robot.frames.map((frame) => body(frame.path, frame.link, null)),
    ...robot.links.map(joint),
    ...robot.frames.map((frame) => triad(make("g", "", group), (all) => {
      const pose = frame.link === null ? BASE : all[frame.link];
      const p = point(pose, frame.path[frame.path.length - 1]);
      return { x: project(p), R: pose.R.map((row) => [0, 1, 2].map((k) => dot(row, frame.axes[k]))), length: 26, depth: dot(p, axes[2]) };
    })),
  ];
  const corner = triad(make("g", "", svg), () => ({ x: [40, HEIGHT - 36], R: BASE.R, length: 26, depth: 0 }));
  const letters = ["x", "y", "z"].map((name) => {
    const letter = make("text", "axis-" + name, svg);
    letter.textContent = name;
    letter.setAttribute("text-anchor", "middle");
    return letter;
  });

  function fit(all) {
    const points = [[0, 0, 0], ...all.map((pose) => pose.p), ...robot.frames.map((frame) => point(frame.link === null ? BASE : all[frame.link], frame.path[frame.path.length - 1]))];
    if (extent === 1e-6) center = [0, 1, 2].map((k) => (Math.max(...points.map((p) => p[k])) + Math.min(...points.map((p) => p[k]))) / 2);
    // Seen once, it stays within the picture.
    extent = Math.max(extent, ...points.map((p) => Math.hypot(...plus(p, center, -1))));
  }
  let order = "";
  function draw(values) {
    const all = poses(values);
    fit(all);
    look();
    places = [];
    const base = project([0, 0, 0]);
    ground.setAttribute("d", `M${at(plus(base, [-24, 9]))}h48` + [0, 1, 2, 3, 4].map((k) => `M${at(plus(base, [10 * k - 16, 9]))}l-7 8`).join(""));
    const depths = pieces.map((piece, i) => [piece.draw(all) - (piece.own.firstChild.getAttribute("class") === "body" ? 1e-3 * extent : 0), i]);
    const sorted = depths.sort((a, b) => a[0] - b[0]).map(([, i]) => i);
    if (order !== sorted.join()) {
      order = sorted.join();
      group.append(...sorted.map((i) => pieces[i].own));
    }
    corner.draw(all);
    letters.forEach((letter, k) => {
      const [x, y] = plus([40, HEIGHT - 36], turned(column(BASE.R, k)), 36);
      letter.setAttribute("x", x.toFixed(1));
      letter.setAttribute("y", (y + 4).toFixed(1));
    });
  }

  function start({ exports }) {
    const { values, configure, move, compute } = functions(exports);
    let asked = false, begun = null;
    const swing = (t) => robot.coordinates.forEach(({ low, high }, i) => {
      const rate = (i % 2 ? 2 : 1) * Math.PI / 2, size = 0.3 * (high - low) / 2;
      const turn = rate * t + i;
      [(low + high) / 2 + size * Math.sin(turn), size * rate * Math.cos(turn), -size * rate * rate * Math.sin(turn)].forEach((value, k) => {
        sliders[k][i].value = value;
        told(sliders[k][i]);
      });
    });
    function frame(time) {
      asked = false;
      if (begun !== null) {
        if (begun === 0) begun = time;
        swing((time - begun) / 1000);
        ask();
      }
      ["q", "qd", "qdd"].forEach((name, k) => sliders[k].forEach((slider, i) => { values[name][i] = Number(slider.value); }));
      move();
      draw(values);
      compute();
      torques(values);
    }
    const ask = () => { if (!asked) requestAnimationFrame(frame); asked = true; };
    const [play, zero] = find("button");
    const stop = () => { begun = null; play.textContent = "Swing"; play.setAttribute("aria-pressed", "false"); };
    section.addEventListener("input", (event) => {
      const slider = event.target;
      if (slider.dataset.state) stop();
      if (slider.dataset.parameter) {
        values.parameters[slider.dataset.parameter] = Number(slider.value);
        configure();
      }
      told(slider);
      ask();
    });
    play.addEventListener("click", () => {
      if (begun !== null) { stop(); return; }
      begun = 0;
      play.textContent = "Stop";
      play.setAttribute("aria-pressed", "true");
      ask();
    });
    zero.addEventListener("click", () => {
      stop();
      for (const slider of [...sliders.flat(), ...payload]) {
        slider.value = slider.defaultValue;
        told(slider);
        if (slider.dataset.parameter) values.parameters[slider.dataset.parameter] = Number(slider.value);
      }
      configure();
      [angles, zoom] = [[...FIRST], 1];
      ask();
    });
    const turn = (azimuth, elevation) => {
      angles = [angles[0] + azimuth, Math.max(-89, Math.min(89, angles[1] + elevation))];
      ask();
    };
    let held = null;
    svg.addEventListener("pointerdown", (event) => { held = [event.clientX, event.clientY]; svg.setPointerCapture(event.pointerId); });
    svg.addEventListener("pointermove", (event) => {
      if (!held) return;
      turn((held[0] - event.clientX) / 2, (event.clientY - held[1]) / 2);
      held = [event.clientX, event.clientY];
    });
    for (const name of ["pointerup", "pointercancel"]) svg.addEventListener(name, () => { held = null; });
    svg.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [5, 0], ArrowRight: [-5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] }[event.key];
      const factor = { "+": 1.1, "=": 1.1, "-": 1 / 1.1 }[event.key];
      if (!step) if (!factor) return;
      event.preventDefault();
      if (factor) zoom *= factor;
      turn(...(step || [0, 0]));
    });
    sliders.flat().concat(payload).forEach((slider) => { slider.value = slider.defaultValue; told(slider); });
    frame(0);
  }

  const bytes = Uint8Array.from(atob(section.dataset.module), (letter) => letter.charCodeAt(0));
  delete section.dataset.module;
  const reveal = () => { for (const part of document.querySelectorAll("[data-live]")) part.hidden = false; };
  WebAssembly.instantiate(bytes).then(({ instance }) => {
    start(instance);
    reveal();
    section.dataset.ready = "";
  }).catch((error) => {
    // What was begun is of no use.
    section.querySelector(".note").textContent = `The robot cannot be moved here: ${error.message}`;
    for (const part of section.querySelectorAll("figure, table, fieldset, button")) part.remove();
    reveal();
  });
})();
