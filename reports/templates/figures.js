// Makes pictures of plots part of the page: an entry of the legend hides what is its in all of them,
// and pointing at a plot tells the nearest value. Without this the pages lack nothing else.
'use strict';
(() => {
  const NEAR = 40;  // [px of the figure]: farther points are not told
  const hidden = new Set();  // entries of the legend, by place
  const figures = [];

  // Axes in gnuplot's enhanced text: what is behind _ and ^ stands lower and higher.
  function addMath(element, text) {
    for (const part of text.split(/([_^]\{[^}]*\})/)) {
      const mark = /^([_^])\{(.*)\}$/.exec(part);
      if (!mark) element.append(part);
      else {
        const small = document.createElement(mark[1] === '_' ? 'sub' : 'sup');
        small.textContent = mark[2];
        element.append(small);
      }
    }
  }

  function toPixel(value, ends, log, from, to) {
    const scale = log ? Math.log : (v) => v;
    return from + (to - from) * (scale(value) - scale(ends[0])) / (scale(ends[1]) - scale(ends[0]));
  }

  const pixelOf = (panel, point) => ({
    x: toPixel(point[0], panel.x, panel.logX, panel.box[0], panel.box[1]),
    y: toPixel(point[1], panel.y, panel.logY, panel.box[3], panel.box[2]),
  });

  const isWithin = (panel, x, y, room) =>
    x >= panel.box[0] - room && x <= panel.box[1] + room && y >= panel.box[2] - room && y <= panel.box[3] + room;

  function nearest(figure, x, y) {
    let best = null;
    for (const panel of figure.data.panels) {
      if (!isWithin(panel, x, y, 8)) continue;
      for (const curve of panel.curves) {
        if (hidden.has(curve.owner)) continue;
        for (const point of curve.points) {
          const at = pixelOf(panel, point);
          if (!isWithin(panel, at.x, at.y, 1)) continue;
          const far = Math.hypot(at.x - x, at.y - y);
          if (far < (best ? best.far : NEAR)) best = { far, panel, curve, point, at };
        }
      }
    }
    return best;
  }

  const tip = document.createElement('div');
  tip.className = 'tip';
  tip.hidden = true;
  document.body.append(tip);

  function line(label, value) {
    const row = document.createElement('div');
    if (label) {
      addMath(row, label);
      row.append(': ');
    }
    row.append(value);
    tip.append(row);
  }

  const inWords = (value) => String(value).replace('-', '−').replace(/e[+]?(.*)/, ' × 10^$1');

  function tell(figure, found, event) {
    const { panel, curve, point, at } = found;
    tip.replaceChildren();
    const name = document.createElement('b');
    name.textContent = curve.name || (curve.owner >= 0 ? names[curve.owner] : '');
    if (name.textContent) tip.append(name);
    const place = point[3] || curve.place;
    if (place) line('', place);
    const barred = typeof point[2] === 'number' ? ' ± ' + inWords(point[2]) : '';  // across, where rows are
    if (panel.rows.length) line('', panel.rows[Math.round(point[1])] || '');
    if (panel.columns.length) line('', panel.columns[Math.round(point[0])] || '');
    else line(panel.xLabel, inWords(point[0]) + (panel.rows.length ? barred : ''));
    if (!panel.rows.length) line(panel.yLabel, inWords(point[1]) + barred);
    tip.hidden = false;
    const room = document.documentElement.clientWidth - tip.offsetWidth - 8;
    tip.style.left = Math.max(4, Math.min(event.clientX + 14, room)) + 'px';
    tip.style.top = Math.max(4, event.clientY - tip.offsetHeight - 12) + 'px';
    figure.mark.setAttribute('cx', at.x);
    figure.mark.setAttribute('cy', at.y);
    figure.mark.style.display = '';
  }

  function look(figure, event) {
    const box = figure.svg.getBoundingClientRect();
    const scale = figure.data.height / box.height;
    const y = figure.data.top + (event.clientY - box.top) * scale;
    const found = nearest(figure, (event.clientX - box.left) * scale, y);
    if (found) tell(figure, found, event);
    else leave(figure);
  }

  function leave(figure) {
    tip.hidden = true;
    figure.mark.style.display = 'none';
  }

  function show(figure) {
    for (const panel of figure.data.panels)
      for (const curve of panel.curves)
        for (const part of curve.parts) {
          const element = figure.svg.querySelector('[id="gnuplot_plot_' + part + '"]');
          if (element) element.style.display = hidden.has(curve.owner) ? 'none' : '';
        }
  }

  // Names of parts are the same in all figures: each is in a tree of its own.
  function makeLive(figure) {
    if (figure.svg) return;
    const bytes = Uint8Array.from(atob(figure.image.src.split(',')[1]), (c) => c.charCodeAt(0));
    const parsed = new DOMParser().parseFromString(new TextDecoder().decode(bytes), 'image/svg+xml');
    const svg = document.importNode(parsed.documentElement, true);
    for (const title of svg.querySelectorAll('title, desc')) title.remove();
    svg.setAttribute('role', 'img');
    svg.setAttribute('aria-label', figure.image.alt);
    svg.setAttribute('style', 'display: block; width: 100%; height: auto; background: #fff');
    const mark = document.createElementNS(svg.namespaceURI, 'circle');
    for (const [name, value] of [['r', 7], ['fill', 'none'], ['stroke', '#444'], ['stroke-width', 1.5]])
      mark.setAttribute(name, value);
    mark.style.display = 'none';
    svg.append(mark);
    const host = document.createElement('div');
    host.className = 'live';
    host.style.cssText = figure.image.style.cssText;
    host.attachShadow({ mode: 'open' }).append(svg);
    figure.image.replaceWith(host);
    Object.assign(figure, { svg, mark });
    for (const type of ['pointermove', 'pointerdown']) host.addEventListener(type, (event) => look(figure, event));
    host.addEventListener('pointerleave', () => leave(figure));
    show(figure);
  }

  for (const source of document.querySelectorAll('figure script[type="application/json"]')) {
    const image = source.closest('figure').querySelector('img');
    if (image) figures.push({ image, data: JSON.parse(source.textContent) });
  }
  if (figures.length === 0) return;
  const seen = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const figure = figures.find((one) => one.image === entry.target);
      if (entry.isIntersecting && figure) {
        seen.unobserve(entry.target);
        makeLive(figure);
      }
    }
  }, { rootMargin: '600px' });
  for (const figure of figures) seen.observe(figure.image);
  addEventListener('beforeprint', () => figures.forEach(makeLive));
  addEventListener('scroll', () => { tip.hidden = true; }, { passive: true });

  const legend = document.getElementById('legend');
  const entries = legend ? [...legend.querySelectorAll('span')] : [];
  const names = entries.map((entry) => entry.textContent);
  const all = document.createElement('button');
  all.textContent = 'show all';
  all.hidden = true;

  function update() {
    entries.forEach((entry, k) => entry.setAttribute('aria-pressed', String(!hidden.has(k))));
    all.hidden = hidden.size === 0;
    for (const figure of figures) if (figure.svg) show(figure);
  }

  entries.forEach((entry, k) => {
    entry.setAttribute('role', 'button');
    entry.tabIndex = 0;
    entry.title = 'hides or shows it in all plots; with Shift: it alone';
    const toggle = (alone) => {
      if (alone) entries.forEach((_, other) => (other === k ? hidden.delete(other) : hidden.add(other)));
      else if (!hidden.delete(k)) hidden.add(k);
      update();
    };
    entry.addEventListener('click', (event) => toggle(event.shiftKey));
    entry.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      toggle(event.shiftKey);
    });
  });
  all.addEventListener('click', () => {
    hidden.clear();
    update();
  });
  if (legend) {
    legend.append(all);
    update();
  }
})();
