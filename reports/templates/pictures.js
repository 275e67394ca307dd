// Pictures of one packing by several engines, put in one place to step or blink between them, and films
// of kept snapshots. Nothing moves before it is asked to; who wants less motion steps. Without this the
// pictures stand side by side, and films show their last instant.
'use strict';
(() => {
  const BLINK = 1000, FRAME = 250;  // [ms]
  const RESOLUTION = 1040;  // of a film [px]
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;

  function slider(label, count, act) {
    const made = document.createElement('input');
    Object.assign(made, { type: 'range', min: 0, max: count - 1, value: 0 });
    made.setAttribute('aria-label', label);
    made.addEventListener('input', () => act(Number(made.value)));
    return made;
  }

  // Goes round `count` places, by itself or, where less motion is wanted, one at a click.
  function player(words, count, period, show) {
    let place = 0, timer = 0;
    const go = (to) => {
      place = to;
      range.value = to;
      range.setAttribute('aria-valuetext', show(to));
    };
    const step = () => go((place + 1) % count);
    const stop = () => {
      clearInterval(timer);
      timer = 0;
      run.textContent = words.start;
    };
    const run = still
      ? button(words.next, 'one further', step)
      : button(words.start, words.title, () => {
        if (timer) return stop();
        timer = setInterval(step, period);
        run.textContent = 'pause';
        step();
      });
    const range = slider(words.label, count, (to) => {
      if (timer) stop();
      go(to);
    });
    return { run, range, go, stop: () => { if (timer) stop(); } };
  }

  function decoded(script) {
    const film = JSON.parse(script.textContent);
    film.bytes = Uint8Array.from(atob(film.data), (c) => c.charCodeAt(0));
    film.radius = film.radii.flatMap(([count, radius]) => Array(count).fill(radius));
    return film;
  }

  function canvasOf(figure) {
    const image = figure.querySelector('img'), canvas = document.createElement('canvas');
    canvas.width = canvas.height = RESOLUTION;
    canvas.setAttribute('role', 'img');
    image.replaceWith(canvas);
    return canvas;
  }

  function draw(film, frame) {
    const pen = film.canvas.getContext('2d'), count = film.radius.length;
    pen.fillStyle = '#fff';
    pen.fillRect(0, 0, RESOLUTION, RESOLUTION);
    for (let k = 0, at = 4 * count * frame; k < count; ++k, at += 4) {
      const [a, b, c, colour] = film.bytes.subarray(at, at + 4);
      pen.fillStyle = k < film.disks ? film.colours[colour] : film.wall;
      pen.beginPath();
      pen.arc(((a << 4) | (b >> 4)) / 4095 * RESOLUTION, (((b & 15) << 8) | c) / 4095 * RESOLUTION,
        film.radius[k] * RESOLUTION, 0, 7);
      pen.fill();
    }
    film.canvas.setAttribute('aria-label', film.name + ': disks coloured by their speed, ' + film.told[frame]);
  }

  function addFilms(figures, tools) {
    const films = figures.filter((figure) => figure.querySelector('script.film'))
      .map((figure) => ({ figure, name: figure.dataset.engine }));
    if (films.length === 0) return;
    const told = document.createElement('span');
    const counts = films.map((film) => JSON.parse(film.figure.querySelector('script.film').textContent).told.length);
    const most = Math.max(...counts);
    const play = player({ start: 'play', next: 'next instant', title: 'all engines at once', label: 'instant' }, most, FRAME, (to) => {
      for (const film of films) {
        if (!film.canvas) Object.assign(film, decoded(film.figure.querySelector('script.film')), { canvas: canvasOf(film.figure) });
        draw(film, Math.min(to, film.told.length - 1));
      }
      told.textContent = films[0].told[Math.min(to, films[0].told.length - 1)];
      return told.textContent;
    });
    play.range.value = most - 1;
    tools.append(play.run, ' ', play.range, ' ', told, ' ');
  }

  function addBlink(block, figures, tools) {
    const told = document.createElement('span');
    const blink = player({ start: 'blink', next: 'next engine', title: 'from engine to engine', label: 'engine' }, figures.length, BLINK, (to) => {
      figures.forEach((figure, k) => figure.classList.toggle('shown', k === to));
      told.textContent = figures[to].dataset.engine;
      return told.textContent;
    });
    const parts = [blink.run, blink.range, told];
    const stack = button('in one place', 'one upon the other, to step between engines', () => {
      const on = block.classList.toggle('stacked');
      stack.setAttribute('aria-pressed', String(on));
      for (const part of parts) part.hidden = !on;
      if (on) blink.go(0);
      else blink.stop();
    });
    stack.setAttribute('aria-pressed', 'false');
    for (const part of parts) part.hidden = true;
    tools.append(stack, ' ', blink.run, ' ', blink.range, ' ', told);
  }

  for (const block of document.querySelectorAll('.pictures')) {
    const figures = [...block.querySelectorAll(':scope > figure[data-engine]')];
    const tools = document.createElement('p');
    tools.className = 'tools';
    addFilms(figures, tools);
    if (figures.length > 1) addBlink(block, figures, tools);
    if (tools.childNodes.length) block.before(tools);
  }
})();
