// Marks the present time in the plots of variables, and the values at it.
(() => {
  function plotting(plots) {
    const host = plots.closest('.run');
    const [begin, end] = ['begin', 'end'].map((name) => Number(plots.dataset[name]));
    const isTimed = plots.dataset.by === 'time';
    const span = end - begin || 1;
    const rows = [...plots.querySelectorAll('tr[data-changes]')].map((row) => ({
      changes: JSON.parse(row.dataset.changes),
      line: row.querySelector('.cursor'),
      value: row.querySelector('.value'),
      width: row.querySelector('svg') && row.querySelector('svg').viewBox.baseVal.width,
    }));

    host.addEventListener('timeshown', (event) => {
      const { time, step } = event.detail;
      const at = isTimed ? Math.min(time, end) : step;
      for (const row of rows) {
        const x = ((at - begin) / span) * row.width;
        row.line.setAttribute('x1', x);
        row.line.setAttribute('x2', x);
        const found = row.changes.findLast(([position]) => position <= step) || row.changes[0];
        [, row.value.textContent] = found;
        row.value.classList.toggle('changed', found[0] === step && step > 0);
      }
    });
    plots.addEventListener('click', (event) => {
      const drawn = event.target.closest('svg');
      if (!drawn) return;
      const there = drawn.getBoundingClientRect();
      const at = begin + ((event.clientX - there.left) / there.width) * span;
      if (isTimed) host.dispatchEvent(new CustomEvent('timenear', { detail: at }));
      else host.dispatchEvent(new CustomEvent('positionwanted', { detail: Math.round(at) }));
    });
  }

  document.querySelectorAll('.plots').forEach(plotting);
  document.addEventListener('runadded', (event) => {
    event.detail.querySelectorAll('.plots').forEach(plotting);
  });
})();
