// Shows what else could happen in the place of the selected step, and after it; a live page follows it.
(() => {
  const panel = document.getElementById('branches');
  if (!panel) return;
  const possible = panel.querySelector('.possible');
  const { live } = panel.dataset;
  const known = new WeakMap();
  const CHANCE = 10; // steps that are made by chance at once

  function branchesOf(run) {
    if (!known.has(run)) {
      const data = run.querySelector('.branches-data');
      known.set(run, data ? JSON.parse(data.textContent) : []);
    }
    return known.get(run);
  }

  function element(name, className, ...children) {
    const made = document.createElement(name);
    if (className) made.className = className;
    made.append(...children);
    return made;
  }

  // The ordinals that lead to a position of a run; null when one of them is not known.
  function pathTo(run, position) {
    const taken = branchesOf(run).slice(0, position).map((each) => each.steps.find((s) => s.taken));
    return taken.length < position || taken.includes(undefined) ? null : taken.map((s) => s.ordinal);
  }

  async function follow(path, chance) {
    panel.toggleAttribute('aria-busy', true);
    try {
      const answer = await fetch(live, {
        method: 'POST',
        headers: { 'Content-Type': 'application/json' },
        body: JSON.stringify({ path, chance }),
      });
      const text = await answer.text();
      if (!answer.ok) throw new Error(text);
      document.dispatchEvent(new CustomEvent('runfollowed', { detail: text }));
    } catch (error) {
      const said = error instanceof TypeError ? 'rebsync no longer answers: start it again' : error.message;
      possible.prepend(element('p', 'failed', said));
    } finally {
      panel.removeAttribute('aria-busy');
    }
  }

  // A button that asks for a run, which goes on by chance for some steps.
  function asking(text, title, path, chance) {
    const button = element('button', '', text);
    button.type = 'button';
    button.title = title;
    button.addEventListener('click', () => follow(path, chance));
    return button;
  }

  function option(run, position, step) {
    const told = element('summary', '', step.what);
    if (step.failure) told.append(element('strong', '', step.failure));
    const listed = step.does.length > 0 ? step.does : ['changes nothing'];
    const does = element('ul', '', ...listed.map((text) => element('li', '', text)));
    const details = element('details', '', told, does);
    const item = element('li', step.taken ? 'taken' : '', details);
    if (step.taken) item.append(element('em', '', 'this run'));
    else if (live && pathTo(run, position)) {
      const path = [...pathTo(run, position), step.ordinal];
      item.append(asking('Follow', `Follow: ${step.what}`, path, 0));
    }
    return item;
  }

  function listed(run, position, title, found, nothing) {
    const parts = [element('h3', '', title)];
    if (!found) return [...parts, element('p', 'quiet', 'Not known.')];
    if (found.unknown) return [...parts, element('p', 'quiet', `Not known: ${found.unknown}.`)];
    const steps = found.steps;
    if (steps.length === 0) return [...parts, element('p', 'quiet', nothing)];
    parts.push(element('ol', '', ...steps.map((step) => option(run, position, step))));
    if (found.more > 0) parts.push(element('p', 'quiet', `and ${found.more} more`));
    return parts;
  }

  function show(run, position, number) {
    const found = branchesOf(run);
    panel.hidden = found.length === 0;
    if (panel.hidden) return;
    const parts = [];
    const here = found[position];
    const others = here && { ...here, steps: here.steps.filter((step) => !step.taken) };
    const alone = 'Nothing else could happen.';
    parts.push(...listed(run, position, `Instead of step ${number}`, others, alone));
    const failed = here && here.steps.some((step) => step.taken && step.failure);
    if (!failed) {
      const end = 'Nothing: the run ends here.';
      const next = found[position + 1];
      parts.push(...listed(run, position + 1, `After step ${number}`, next, end));
      const path = live && next && next.steps.length > 0 && pathTo(run, position + 1);
      if (path) {
        const title = `Go on by chance after step ${number}`;
        parts.push(asking(`${CHANCE} steps by chance`, title, path, CHANCE));
      }
    }
    if (!live) {
      const command = element('code', '', 'rebsync simulate MODEL --serve');
      parts.push(element('p', 'quiet', command, ' follows other steps.'));
    }
    possible.replaceChildren(...parts);
    panel.scrollTop = 0;
  }

  function watch(run) {
    run.addEventListener('stepselected', (event) => {
      const rows = [...run.querySelectorAll('.states tbody tr')];
      const position = rows.findIndex((row) => row.dataset.step === String(event.detail));
      if (position >= 0) show(run, position, event.detail);
    });
  }

  document.querySelectorAll('.run').forEach(watch);
  document.addEventListener('runadded', (event) => watch(event.detail));
})();
