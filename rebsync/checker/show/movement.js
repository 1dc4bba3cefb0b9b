// Plays the movement of robots. All that it draws is in the data of the page, computed before.
(() => {
  const PAUSE = 150; // ms on a step at whose time others happen too

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

  function player(root) {
    const scene = JSON.parse(root.querySelector('.scene-data').textContent);
    const host = root.closest('.run') || root;
    const chart = document.getElementById(root.dataset.chart);
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
    const slider = root.querySelector('.time');
    const clock = root.querySelector('.clock');
    const play = root.querySelector('[data-act=play]');
    const speed = root.querySelector('.speed');
    let step = 0; // its position among the steps
    let time = scene.begin;
    let playing = 0; // the number of the frame that is asked for
    let asking = false;

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
      slider.value = time;
      slider.setAttribute('aria-valuetext', `time ${text(time)}`);
      clock.textContent = `time ${text(time)}, step ${scene.steps[step][0]}`;
      root.dataset.time = time;
      root.dataset.step = scene.steps[step][0];
    }

    // The last step that has happened at a time.
    const stepAt = (at) => Math.max(scene.steps.findLastIndex((each) => each[1] <= at), 0);

    function toStep(position) {
      if (position !== step) {
        step = position;
        drawValues();
        asking = true;
        const detail = scene.steps[step][0];
        host.dispatchEvent(new CustomEvent('stepwanted', { detail }));
        asking = false;
        mark();
      }
    }

    // Marks the step in a chart that nobody else looks after.
    function mark() {
      if (!chart) return;
      const number = scene.steps[step][0];
      chart.querySelectorAll('.on').forEach((part) => part.classList.remove('on'));
      chart.querySelectorAll(`[data-step="${number}"]`).forEach((part) => part.classList.add('on'));
      const row = chart.querySelector(`.row[data-step="${number}"]`);
      if (!row) return;
      const [there, here] = [chart.getBoundingClientRect(), row.getBoundingClientRect()];
      if (here.top < there.top || here.bottom > there.bottom) {
        chart.scrollTop += here.top - there.top - there.height / 2;
      }
    }

    function toTime(at) {
      time = Math.min(Math.max(at, scene.begin), scene.end);
      toStep(stepAt(time));
      draw();
    }

    function stop() {
      if (playing) cancelAnimationFrame(playing);
      playing = 0;
      play.textContent = 'Play';
      root.classList.remove('playing');
    }

    // Time goes on with the clock, but stays a moment at each of several steps at one time.
    function start() {
      if (time >= scene.end) {
        time = scene.begin;
        toStep(0);
      }
      play.textContent = 'Pause';
      root.classList.add('playing');
      let last = performance.now();
      let stays = last + PAUSE;
      const frame = (now) => {
        const passed = Math.max(now - last, 0);
        last = now;
        if (!root.checkVisibility()) return stop();
        const following = scene.steps[step + 1];
        if (now < stays) {
          // the step is seen
        } else if (following && following[1] <= time) {
          toStep(step + 1);
          stays = now + PAUSE / Math.max(Number(speed.value), 1);
        } else {
          time += (passed / 1000) * Number(speed.value);
          if (following && time >= following[1]) time = following[1];
        }
        if (time >= scene.end && !scene.steps[step + 1]) {
          time = scene.end;
          draw();
          return stop();
        }
        draw();
        playing = requestAnimationFrame(frame);
      };
      playing = requestAnimationFrame(frame);
    }

    function walk(distance) {
      stop();
      const next = Math.min(Math.max(step + distance, 0), scene.steps.length - 1);
      time = scene.steps[next][1];
      toStep(next);
      draw();
    }

    const acts = {
      play: () => (playing ? stop() : start()), back: () => walk(-1), forward: () => walk(1),
    };
    root.addEventListener('click', (event) => {
      const button = event.target.closest('button');
      if (!button) return;
      if (button.dataset.act) acts[button.dataset.act]();
      else {
        stop();
        toTime(Number(button.dataset.time));
      }
    });
    slider.addEventListener('input', () => {
      stop();
      toTime(Number(slider.value));
    });
    host.addEventListener('stepselected', (event) => {
      if (asking) return;
      const position = scene.steps.findIndex((each) => each[0] === Number(event.detail));
      if (position < 0) return;
      stop();
      step = position;
      time = scene.steps[step][1];
      drawValues();
      draw();
    });
    host.addEventListener('playwanted', () => acts.play());
    if (chart) {
      chart.addEventListener('click', (event) => {
        const part = event.target.closest('[data-step]');
        const at = part ? scene.steps.findIndex((each) => each[0] === Number(part.dataset.step)) : -1;
        if (at >= 0) walk(at - step);
      });
      document.addEventListener('keydown', (event) => {
        const act = { p: 'play', j: 'forward', k: 'back' }[event.key];
        const typed = event.target.matches('input, select');
        if (act && !typed && !event.ctrlKey && !event.metaKey && !event.altKey) acts[act]();
      });
      document.documentElement.classList.add('js');
    }
    drawValues();
    draw();
  }

  document.querySelectorAll('.movement').forEach(player);
})();
