"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const canvas = document.getElementById("canvas");
  const selected = document.getElementById("selected");
  const search = document.getElementById("search");
  const list = document.getElementById("list");
  const boxes = [...canvas.querySelectorAll("[data-box]")];
  const wires = [...canvas.querySelectorAll(".wire")];
  const items = [...list.querySelectorAll("[data-item]")];
  const whole = canvas.viewBox.baseVal;
  const all = { x: whole.x, y: whole.y, width: whole.width, height: whole.height };
  let view = { ...all };

  const show = (next) => {
    view = next;
    canvas.setAttribute("viewBox", `${view.x} ${view.y} ${view.width} ${view.height}`);
  };
  const part = (name, text, parent) => {
    const made = document.createElement(name);
    made.textContent = text;
    parent.append(made);
    return made;
  };

  // --- lines of code

  const line = (place, what) => {
    if (!place) return;
    part("p", `${what} ${place.file}:${place.line}`, selected);
    part("pre", place.text, selected);
  };
  const about = (title, types, note) => {
    selected.textContent = "";
    part("h3", title, selected);
    if (types.length) part("p", types.join(" or "), selected);
    if (note) part("p", note, selected);
  };
  const quality = (wire) => {
    if (!wire.qos) return "";
    const { reliability, durability } = wire.qos;
    return ` (${reliability}, ${durability})`;
  };
  const near = (numbers, lit) => {
    canvas.classList.toggle("some", numbers.size > 0);
    boxes.forEach((box, i) => box.classList.toggle("near", numbers.has(i)));
    wires.forEach((wire, i) => wire.classList.toggle("near", lit.has(i)));
  };
  const choose = (number) => {
    const box = data.boxes[number];
    const joined = data.wires.map((wire, i) => [wire, i])
      .filter(([wire]) => wire.from === number || wire.to === number);
    near(new Set([number, ...joined.flatMap(([w]) => [w.from, w.to])]),
      new Set(joined.map(([, i]) => i)));
    boxes.forEach((each, i) => each.classList.toggle("on", i === number));
    items.forEach((each) => each.classList.toggle("on", Number(each.dataset.item) === number));
    about(box.name, box.types, box.note);
    if (box.package) part("p", `${box.package}/${box.label || ""}`, selected);
    line(box.place, box.kind);
    for (const [wire] of joined) {
      const other = data.boxes[wire.from === number ? wire.to : wire.from];
      line(wire.place, `${wire.role}: ${other.name}${quality(wire)}`);
    }
  };
  const clear = () => {
    selected.textContent = "";
    near(new Set(), new Set());
    boxes.forEach((each) => each.classList.remove("on"));
    items.forEach((each) => each.classList.remove("on"));
  };
  const chooseWire = (number) => {
    const wire = data.wires[number];
    near(new Set([wire.from, wire.to]), new Set([number]));
    about(`${data.boxes[wire.from].name} to ${data.boxes[wire.to].name}`, wire.types, "");
    line(wire.place, wire.role + quality(wire));
  };
  const goTo = (number) => {
    const at = boxes[number].transform.baseVal.consolidate().matrix;
    const size = Math.min(1100, all.width), high = size * all.height / all.width;
    const ratio = canvas.clientHeight / Math.max(canvas.clientWidth, 1);
    show({ x: at.e - size / 2 + 60, y: at.f - size * ratio / 2 + 30,
      width: size, height: Math.max(high, size * ratio) });
    choose(number);
  };

  // --- the list and its groups

  const group = (key) => {
    list.textContent = "";
    const groups = new Map();
    for (const item of items) {
      const name = item.dataset[key];
      groups.set(name, [...(groups.get(name) || []), item]);
    }
    for (const [name, members] of [...groups].sort(([a], [b]) => a.localeCompare(b))) {
      const held = document.createElement("details");
      held.open = members.length < 40 || groups.size < 3;
      held.dataset.group = name;
      part("summary", `${name} (${members.length})`, held).addEventListener("click", () => {
        clear();
        const numbers = new Set(members.map((m) => Number(m.dataset.item)));
        const lit = new Set();
        data.wires.forEach((wire, i) => {
          if (numbers.has(wire.from) || numbers.has(wire.to)) lit.add(i);
        });
        lit.forEach((i) => [data.wires[i].from, data.wires[i].to].forEach((n) => numbers.add(n)));
        near(numbers, lit);
      });
      members.forEach((m) => held.append(m));
      list.append(held);
    }
  };
  const find = () => {
    const word = search.value.trim().toLowerCase();
    const hits = new Set();
    items.forEach((item) => {
      const box = data.boxes[Number(item.dataset.item)];
      const text = [box.name, box.package, box.label, ...box.types].join(" ").toLowerCase();
      const hit = word === "" || text.includes(word);
      item.hidden = !hit;
      if (hit && word) hits.add(Number(item.dataset.item));
    });
    document.getElementById("hits").textContent = word ? `${hits.size} found` : "";
    clear();
    if (word) near(hits.size ? hits : new Set([-1]), new Set());
    return hits;
  };

  document.getElementById("grouping").addEventListener("change", (e) => group(e.target.value));
  search.addEventListener("input", find);
  search.addEventListener("keydown", (e) => {
    if (e.key === "Enter") {
      const [first] = find();
      if (first !== undefined) goTo(first);
    }
  });
  list.addEventListener("click", (e) => {
    const item = e.target.closest("[data-item]");
    if (item) goTo(Number(item.dataset.item));
  });
  const findings = document.getElementById("findings");
  if (findings) findings.addEventListener("click", (e) => {
    const entry = e.target.closest("[data-finding]");
    if (!entry) return;
    const finding = data.findings[Number(entry.dataset.finding)];
    const same = (p) => p && p.file === finding.place.file && p.line === finding.place.line;
    const wire = data.wires.findIndex((w) => same(w.place));
    const box = data.boxes.findIndex((b) => same(b.place));
    if (wire >= 0) { goTo(data.wires[wire].from); chooseWire(wire); }
    else if (box >= 0) goTo(box);
    about(`${finding.code} ${finding.message}`, [], finding.hint);
    line(finding.place, finding.severity);
    finding.others.forEach((other) => line(other.place, other.what));
  });

  // --- moving and zooming

  const scale = () => Math.max(view.width / canvas.clientWidth, view.height / canvas.clientHeight);
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    const by = Math.exp(e.deltaY * 0.0015);
    const frame = canvas.getScreenCTM().inverse();
    const x = e.clientX * frame.a + frame.e, y = e.clientY * frame.d + frame.f;
    show({ x: x - (x - view.x) * by, y: y - (y - view.y) * by,
      width: view.width * by, height: view.height * by });
  }, { passive: false });
  let from = null, moved = false;
  canvas.addEventListener("pointerdown", (e) => {
    from = { x: e.clientX, y: e.clientY, view };
    moved = false;
  });
  canvas.addEventListener("pointermove", (e) => {
    if (!from) return;
    const dx = e.clientX - from.x, dy = e.clientY - from.y;
    if (Math.abs(dx) + Math.abs(dy) < 4 && !moved) return;
    moved = true;
    canvas.classList.add("moving");
    show({ ...from.view, x: from.view.x - dx * scale(), y: from.view.y - dy * scale() });
  });
  addEventListener("pointerup", () => { from = null; canvas.classList.remove("moving"); });
  canvas.addEventListener("click", (e) => {
    if (moved) return;
    const box = e.target.closest("[data-box]");
    const wire = wires.indexOf(e.target);
    if (box) choose(Number(box.dataset.box));
    else if (wire >= 0) chooseWire(wire);
    else clear();
  });
  canvas.addEventListener("keydown", (e) => {
    const box = e.target.closest("[data-box]");
    if (box && e.key === "Enter") choose(Number(box.dataset.box));
  });
  addEventListener("keydown", (e) => {
    if (e.target === search) return;
    if (e.key === "/") { e.preventDefault(); search.focus(); }
    if (e.key === "0") { show({ ...all }); clear(); }
    if (e.key === "Escape") clear();
  });
  group("package");
  // What would be too small to read begins at its leftmost box; 0 shows all of it.
  const most = 1.4; // units of the drawing in a pixel
  if (boxes.length && scale() > most) {
    const spots = boxes.map((box) => box.getBoundingClientRect()).sort((a, b) => a.left - b.left);
    const frame = canvas.getScreenCTM().inverse();
    const y = (spots[0].top + spots[0].bottom) / 2 * frame.d + frame.f;
    const width = canvas.clientWidth * most, height = canvas.clientHeight * most;
    show({ x: all.x, y: y - height / 2, width, height });
  }
})();
