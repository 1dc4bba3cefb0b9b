// Draws the movement of robots at the time of the playback. All of it was computed before.
(() => {
  // The pose of a way at a time: straight between the two poses around it.
  function poseAt(path, time) {
    let low = 0;
    let high = path.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (path[middle][0] <= time) low = middle + 1;
      else high = middle;
    }
    const before = path[Math.max(low - 1, 0)];
    const after = path[Math.min(low, path.length - 1)];
    const span = after[0] - before[0];
    const share = span > 0 ? Math.min(Math.max((time - before[0]) / span, 0), 1) : 0;
    return [1, 2, 3].map((i) => before[i] + (after[i] - before[i]) * share);
  }

  const text = (value) => String(Math.round(value * 100) / 100);

  function drawing(root) {
    const scene = JSON.parse(root.querySelector('.scene-data').textContent);
    const host = root.closest('.run') || root;
    const board = root.querySelector('.board');
    const [cell, zeroX, zeroY, below] =
      ['cell', 'x', 'y', 'below'].map((name) => Number(board.dataset[name]));
    const robots = scene.robots.map((each, i) => ({
      ...each,
      drawn: board.querySelector(`.robot[data-robot="${i}"]`),
      row: root.querySelector(`tr[data-robot="${i}"]`),
      label: board.querySelector(`[data-name="${i}"]`),
    }));
    const clash = board.querySelector('.clash');
    let step = 0; // its position among the steps
    let time = scene.begin;

    const pixels = (x, y) => [zeroX + x * cell, zeroY - y * cell];

    function drawRobot(robot) {
      const [x, y, heading] = poseAt(robot.path, time);
      const [px, py] = pixels(x, y);
      robot.drawn.setAttribute('transform', `translate(${px.toFixed(2)} ${py.toFixed(2)})`);
      robot.drawn.querySelector('.body')
        .setAttribute('transform', `rotate(${((-heading * 180) / Math.PI).toFixed(2)})`);
      robot.drawn.classList.toggle('lost', robot.lost !== null && time >= robot.lost);
      robot.at = [x, y, heading];
      robot.row.querySelector('.place').textContent = `(${text(x)}, ${text(y)})`;
    }

    // Names are below their robots, but above where an earlier one is about there.
    function drawNames() {
      robots.forEach((robot, i) => {
        const [x, y] = robot.at;
        const taken = robots.slice(0, i).some((other) => (
          Math.abs(other.at[0] - x) < 0.75 && Math.abs(other.at[1] - y) < 0.75));
        const [px, py] = pixels(x, y);
        robot.label.setAttribute('x', px);
        robot.label.setAttribute('y', taken ? py - below + 9 : py + below);
      });
    }

    function drawMeetings() {
      const now = scene.encounters.filter((each) => each.from <= time && time <= each.until);
      const names = new Set(now.flatMap((each) => each.robots));
      robots.forEach((robot) => {
        robot.drawn.classList.toggle('meets', names.has(robot.name));
        robot.row.classList.toggle('meets', names.has(robot.name));
      });
      clash.toggleAttribute('hidden', now.length === 0);
      if (!now.length) return;
      const [one, other] = now[0].robots.map((name) => robots.find((each) => each.name === name));
      const middle = [0, 1].map((i) => Math.round((one.at[i] + other.at[i]) / 2));
      const [px, py] = pixels(...middle);
      clash.setAttribute('x', px - cell / 2);
      clash.setAttribute('y', py - cell / 2);
    }

    // The values after the step; those that it changed are marked.
    function drawValues() {
      const values = new Map();
      for (const [at, robot, variable, value] of scene.changes) {
        if (at > step) break;
        values.set(`${robot} ${variable}`, [value, at === step && at > 0]);
      }
      for (const [key, [value, isNew]] of values) {
        const [robot, variable] = key.split(' ');
        const place = robots[robot].row.querySelector(`[data-variable="${variable}"]`);
        if (!place) continue;
        place.textContent = value;
        place.classList.toggle('changed', isNew);
      }
    }

    function draw() {
      robots.forEach(drawRobot);
      drawNames();
      drawMeetings();
      root.dataset.time = time;
      root.dataset.step = scene.steps[step];
    }

    root.addEventListener('click', (event) => {
      const button = event.target.closest('button[data-time]');
      if (!button) return;
      host.dispatchEvent(new CustomEvent('timewanted', { detail: Number(button.dataset.time) }));
    });
    host.addEventListener('timeshown', (event) => {
      const before = step;
      ({ time, step } = event.detail);
      if (step !== before) drawValues();
      draw();
    });
    drawValues();
    draw();
  }

  document.querySelectorAll('.movement').forEach(drawing);
  document.addEventListener('runadded', (event) => {
    event.detail.querySelectorAll('.movement').forEach(drawing);
  });
})();
