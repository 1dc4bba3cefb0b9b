// Knows step and time of a run, and plays it. What draws them listens to `timeshown`.
(() => {
  const PAUSE = 150; // ms on a step at whose time others happen too
  const BEAT = 400; // ms on a step where no time passes at all

  const text = (value) => String(Math.round(value * 100) / 100);

  function player(controls) {
    const { begin, end, steps } = JSON.parse(controls.querySelector('.playback-data').textContent);
    const host = controls.closest('.run') || controls.closest('.movement');
    const chart = document.getElementById(controls.dataset.chart);
    const slider = controls.querySelector('.time');
    const clock = controls.querySelector('.clock');
    const play = controls.querySelector('[data-act=play]');
    const speed = controls.querySelector('.speed');
    const isTimed = end > begin;
    const pause = isTimed ? PAUSE : BEAT;
    const last = steps.length - 1;
    let step = 0; // its position among the steps
    let time = begin;
    let playing = 0; // the number of the frame that is asked for
    let asking = false;

    function tell() {
      const [number] = steps[step];
      slider.value = isTimed ? time : step;
      slider.setAttribute('aria-valuetext', `time ${text(time)}, step ${number}`);
      clock.textContent = `${isTimed ? `time ${text(time)}, ` : ''}step ${number} of ${steps[last][0]}`;
      host.dispatchEvent(new CustomEvent('timeshown', { detail: { time, step } }));
    }

    // The last step that has happened at a time.
    const stepAt = (at) => Math.max(steps.findLastIndex((each) => each[1] <= at), 0);

    function toStep(position) {
      if (position === step) return;
      step = position;
      asking = true;
      host.dispatchEvent(new CustomEvent('stepwanted', { detail: steps[step][0] }));
      asking = false;
      mark();
    }

    // Marks the step in a chart that nobody else looks after.
    function mark() {
      if (!chart) return;
      const [number] = steps[step];
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
      stop();
      time = Math.min(Math.max(at, begin), end);
      toStep(stepAt(time));
      tell();
    }

    // A time that somebody points at: that of a step, if one is near.
    function snapped(at) {
      const near = steps.map((each) => each[1])
        .reduce((best, each) => (Math.abs(each - at) < Math.abs(best - at) ? each : best));
      return Math.abs(near - at) <= (end - begin) / 100 ? near : at;
    }

    function stop() {
      if (playing) cancelAnimationFrame(playing);
      playing = 0;
      play.textContent = 'Play';
      controls.classList.remove('playing');
    }

    // Time goes on with the clock, but stays a moment at each of several steps at one time.
    function start() {
      if (time >= end && step === last) {
        time = begin;
        toStep(0);
      }
      play.textContent = 'Pause';
      controls.classList.add('playing');
      let before = performance.now();
      let stays = before + pause;
      const frame = (now) => {
        const passed = Math.max(now - before, 0);
        before = now;
        if (!controls.checkVisibility()) return stop();
        const following = steps[step + 1];
        if (now < stays) {
          // the step is seen
        } else if (following && following[1] <= time) {
          toStep(step + 1);
          stays = now + pause / Math.max(Number(speed.value), 1);
        } else {
          time += (passed / 1000) * Number(speed.value);
          if (following && time >= following[1]) time = following[1];
        }
        if (time >= end && !steps[step + 1]) {
          time = end;
          tell();
          return stop();
        }
        tell();
        playing = requestAnimationFrame(frame);
      };
      playing = requestAnimationFrame(frame);
    }

    function toPosition(position) {
      stop();
      const next = Math.min(Math.max(position, 0), last);
      time = steps[next][1];
      toStep(next);
      tell();
    }

    const acts = {
      play: () => (playing ? stop() : start()),
      back: () => toPosition(step - 1),
      forward: () => toPosition(step + 1),
      first: () => toPosition(0),
      last: () => toPosition(last),
    };
    controls.addEventListener('click', (event) => {
      const button = event.target.closest('button');
      if (button) acts[button.dataset.act]();
    });
    slider.addEventListener('input', () => {
      if (isTimed) toTime(Number(slider.value));
      else toPosition(Number(slider.value));
    });
    host.addEventListener('timenear', (event) => toTime(snapped(event.detail)));
    host.addEventListener('timewanted', (event) => toTime(event.detail));
    host.addEventListener('positionwanted', (event) => toPosition(event.detail));
    host.addEventListener('stepselected', (event) => {
      if (asking) return;
      const position = steps.findIndex((each) => each[0] === Number(event.detail));
      if (position < 0) return;
      stop();
      step = position;
      time = steps[step][1];
      tell();
    });
    host.addEventListener('playwanted', () => acts.play());
    if (chart) {
      chart.addEventListener('click', (event) => {
        const part = event.target.closest('[data-step]');
        const at = part ? steps.findIndex((each) => each[0] === Number(part.dataset.step)) : -1;
        if (at >= 0) toPosition(at);
      });
      document.addEventListener('keydown', (event) => {
        const act = { p: 'play', j: 'forward', k: 'back' }[event.key];
        const typed = event.target.matches('input, select');
        if (act && !typed && !event.ctrlKey && !event.metaKey && !event.altKey) acts[act]();
      });
      document.documentElement.classList.add('js');
    }
    tell();
  }

  document.querySelectorAll('.controls').forEach(player);
  document.addEventListener('runadded', (event) => {
    event.detail.querySelectorAll('.controls').forEach(player);
  });
})();
