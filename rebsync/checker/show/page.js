'use strict';
// Selecting a step marks its row in the chart, its state, and its line of the model.
(() => {
  let runs = [...document.querySelectorAll('.run')];
  let run = null;
  let step = null;

  const rows = () => [...run.querySelectorAll('.states tbody tr')];
  const parts = (name) => run.querySelectorAll(`.msc [data-${name}="${step}"]`);

  function unmark(root, kind) {
    root.querySelectorAll(`.on${kind}`).forEach((part) => part.classList.remove('on'));
  }

  // The rectangle around some parts.
  function around(parts) {
    const all = parts.map((part) => part.getBoundingClientRect());
    return {
      left: Math.min(...all.map((one) => one.left)),
      right: Math.max(...all.map((one) => one.right)),
      top: Math.min(...all.map((one) => one.top)),
      bottom: Math.max(...all.map((one) => one.bottom)),
    };
  }

  // Scrolls only the pane of a place, and only when the place is out of view: to its middle.
  function reveal(place, pane) {
    const there = pane.getBoundingClientRect();
    const head = pane.querySelector('.heads, thead');
    const top = there.top + (head ? head.getBoundingClientRect().height : 0);
    if (place.top < top || place.bottom > there.bottom) {
      const spare = there.bottom - top - (place.bottom - place.top);
      pane.scrollTop += place.top - top - Math.max(spare / 2, 0);
    }
  }

  // The same from left to right; of what is wider than its pane, the beginning.
  function revealAcross(place, pane) {
    const there = pane.getBoundingClientRect();
    const stays = pane.querySelector('tbody .when'); // step and time stay at the left
    const left = stays ? stays.getBoundingClientRect().right : there.left;
    if (place.left < left) pane.scrollLeft -= left - place.left + 12;
    if (place.right > there.right) {
      pane.scrollLeft += Math.min(place.right - there.right + 12, place.left - left - 12);
    }
  }

  // What is beside the panes may take some of their room.
  const sizes = new ResizeObserver(() => step !== null && revealSelected());

  function show(number) {
    run = runs[number];
    sizes.disconnect();
    run.querySelectorAll('.panes > .pane').forEach((pane) => sizes.observe(pane));
    runs.forEach((each) => each.classList.toggle('on', each === run));
    document.querySelectorAll('nav a').forEach((tab) => {
      if (tab.dataset.run === run.dataset.run) tab.setAttribute('aria-current', 'true');
      else tab.removeAttribute('aria-current');
    });
    step = null;
  }

  function select(row, focus) {
    unmark(document, ':not(.run)');
    rows().forEach((each) => each.removeAttribute('aria-current'));
    step = row.dataset.step;
    row.classList.add('on');
    row.setAttribute('aria-current', 'step');
    row.tabIndex = 0;
    if (focus) row.focus({ preventScroll: true });
    for (const name of ['step', 'taken', 'sent']) {
      parts(name).forEach((part) => part.classList.add('on'));
    }
    run.dispatchEvent(new CustomEvent('stepselected', { detail: step }));
    const line = row.dataset.line && document.getElementById(`L${row.dataset.line}`);
    if (line) line.classList.add('on');
    revealSelected();
  }

  // What is hidden has no place: it is revealed when it is shown.
  function revealSelected() {
    const row = rows().find((each) => each.dataset.step === step);
    if (!row) return;
    if (row.checkVisibility()) revealRow(row);
    const drawn = run.querySelector(`.msc .step[data-step="${step}"]`);
    if (drawn.checkVisibility()) revealStep(drawn);
    const line = document.querySelector('.lines tr.on');
    if (line && line.checkVisibility()) reveal(around([line]), line.closest('.texts'));
  }

  // Scrolling across hides what happens in a step: only a variable that cannot be seen is worth it.
  function revealRow(row) {
    const pane = row.closest('.pane');
    const wrong = row.classList.contains('wrong'); // then what is wrong has to be read first
    const changed = row.querySelector(wrong ? '.what' : '.changed:not(:has(.bag))');
    reveal(around([row]), pane);
    // Without the chart nothing else says what happens.
    if (!changed || !(wrong || run.querySelector('.chart').checkVisibility())) return;
    const place = around([changed]);
    const seen = Math.min(place.right, place.left + 80);
    revealAcross(seen <= pane.getBoundingClientRect().right ? { ...place, right: seen } : place, pane);
  }

  // Where the texts beside a place end that the three steps before have in the same column.
  function rightOfColumn(place) {
    const before = [1, 2, 3].map((n) => `.msc .step[data-step="${step - n}"] text:not(.number)`);
    const texts = [...run.querySelectorAll(before.join())].map((one) => one.getBoundingClientRect());
    const beside = texts.filter((one) => one.left >= place.left && one.left < place.right);
    return Math.max(place.right, ...beside.map((one) => one.right));
  }

  // A step of one rebec is revealed with all its texts.
  function revealStep(drawn) {
    const pane = drawn.closest('.pane');
    const bodies = [...drawn.querySelectorAll('.body')];
    reveal(around([...drawn.querySelectorAll('rect, text')]), pane);
    if (bodies.length === 1) {
      const place = around([...bodies, ...drawn.querySelectorAll('text:not(.number)')]);
      revealAcross({ ...place, right: rightOfColumn(place) }, pane);
    }
  }

  function choose(row) {
    select(row, true);
    history.replaceState(null, '', `#${row.id}`);
  }

  // The step that runs a line: the next one after the selected step, then from the first one.
  function atLine(number) {
    const all = rows();
    const from = all.findIndex((row) => row.dataset.step === step) + 1;
    return [...all.slice(from), ...all.slice(0, from)].find((row) => row.dataset.line === number);
  }

  function move(distance) {
    const all = rows();
    const at = all.findIndex((row) => row.dataset.step === step);
    choose(all[Math.min(Math.max(at + distance, 0), all.length - 1)]);
  }

  function turn(distance) {
    const next = runs.indexOf(run) + distance;
    if (next < 0 || next >= runs.length) return;
    show(next);
    move(1);
  }

  const keys = {
    j: () => move(1), ArrowDown: () => move(1), k: () => move(-1), ArrowUp: () => move(-1),
    p: () => run.dispatchEvent(new CustomEvent('playwanted')),
    Home: () => move(-Infinity), End: () => move(Infinity), '[': () => turn(-1), ']': () => turn(1),
  };

  function fromAddress() {
    const [, number, at] = /^#v(\d+)(?:-s(\d+))?$/.exec(location.hash) || [];
    const place = runs.findIndex((each) => each.dataset.run === number);
    if (place < 0) return false;
    show(place);
    const row = rows().find((each) => each.dataset.step === at);
    select(row || rows().pop(), false);
    return true;
  }

  // Which parts of the page are shown: in a wide window several, in a narrow one at a time.
  const views = [...document.querySelectorAll('.views button')];

  function drawViews() {
    const { classList, dataset } = document.body;
    const isNarrow = matchMedia('(max-width: 1100px)').matches;
    views.forEach((button) => {
      const { view } = button.dataset;
      const shown = isNarrow ? dataset.only === view : !classList.contains(`hide-${view}`);
      button.setAttribute('aria-pressed', String(shown));
    });
    revealSelected();
  }

  views.forEach((button) => button.addEventListener('click', () => {
    const { view } = button.dataset;
    if (matchMedia('(max-width: 1100px)').matches) document.body.dataset.only = view;
    else document.body.classList.toggle(`hide-${view}`);
    drawViews();
  }));

  // Who plays a run asks for its steps.
  function watch(each) {
    each.addEventListener('stepwanted', (event) => {
      const row = rows().find((one) => one.dataset.step === String(event.detail));
      if (each === run && row) select(row, false);
    });
  }

  // A run that was followed takes the place of the one before, and is shown at its end.
  function addRun(text) {
    const made = new DOMParser().parseFromString(text, 'text/html').querySelector('.run');
    const old = document.getElementById(made.id);
    if (old) old.replaceWith(made);
    else runs[runs.length - 1].after(made);
    runs = [...document.querySelectorAll('.run')];
    const tabs = document.querySelector('nav');
    if (!tabs.querySelector(`[data-run="${made.dataset.run}"]`)) {
      const tab = document.createElement('a');
      tab.href = `#${made.id}`;
      tab.dataset.run = made.dataset.run;
      tab.textContent = 'what if';
      tabs.append(tab);
    }
    watch(made);
    document.dispatchEvent(new CustomEvent('runadded', { detail: made }));
    show(runs.indexOf(made));
    choose(rows().pop());
  }

  if (runs.length === 0) return;
  document.documentElement.classList.add('js');
  runs.forEach(watch);
  document.addEventListener('runfollowed', (event) => addRun(event.detail));
  window.addEventListener('resize', drawViews);
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches('input, select')) return;
    if (!(event.key in keys)) return;
    event.preventDefault();
    keys[event.key]();
  });
  document.addEventListener('click', (event) => {
    if (event.target.closest('a, input, label, button, summary, .movement, .plots, .branches')) return;
    const part = event.target.closest('[data-step]');
    const line = event.target.closest('#source [data-line]');
    const flight = event.target.closest('.flight');
    const wanted = part ? part.dataset.step : flight && (flight.dataset.taken || flight.dataset.sent);
    const row = wanted ? rows().find((each) => each.dataset.step === wanted)
      : line && atLine(line.dataset.line);
    if (row) choose(row);
  });
  window.addEventListener('hashchange', fromAddress);
  if (!fromAddress()) {
    show(0);
    select(rows().pop(), false);
  }
  drawViews();
})();
