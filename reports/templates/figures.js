// Makes pictures of plots part of the page: an entry of the legend hides what is its in all of them,
// pointing at a plot tells the nearest value and marks the same ring in the others, and lines of each
// packing are drawn when they are asked for. Without this the pages lack nothing else.
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

  let svgSpace = '';  // of the drawings' names
  function drawn(name, attributes) {
    const element = document.createElementNS(svgSpace, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  }

  // A ring has the same name in every plot: a line where it is, a circle at the same engine's value.
  function link(place, owner) {
    for (const figure of figures) {
      if (!figure.svg) continue;
      figure.linked.replaceChildren();
      if (!place) continue;
      for (const panel of figure.data.panels) {
        let lined = false;
        for (const curve of panel.curves) {
          if (hidden.has(curve.owner)) continue;
          const point = curve.points.find((one) => one[3] === place);
          if (!point) continue;
          const at = pixelOf(panel, point);
          if (!lined) figure.linked.append(drawn('path', { d: `M${at.x} ${panel.box[2]}V${panel.box[3]}`, stroke: '#444', 'stroke-dasharray': '3,3' }));
          lined = true;
          if (curve.owner === owner && isWithin(panel, at.x, at.y, 1))
            figure.linked.append(drawn('circle', { cx: at.x, cy: at.y, r: 7, fill: 'none', stroke: '#444', 'stroke-width': 1.5 }));
        }
      }
    }
  }

  // What curves are means of, thin and pale, cut off at the edges of each panel.
  function drawEach(figure) {
    for (const panel of figure.data.panels) {
      const [left, right, upper, lower] = panel.box, size = `${left} ${upper} ${right - left} ${lower - upper}`;
      const view = drawn('svg', { x: left, y: upper, width: right - left, height: lower - upper, viewBox: size });
      for (const curve of panel.curves) {
        if (!curve.each || hidden.has(curve.owner)) continue;
        for (const one of curve.each) {
          let d = '', pen = 'M';
          one.forEach((y, k) => {
            if (y === null) {
              pen = 'M';
              return;
            }
            const at = pixelOf(panel, [curve.points[k][0], y]);
            d += `${pen}${at.x.toFixed(1)} ${at.y.toFixed(1)}`;
            pen = 'L';
          });
          view.append(drawn('path', { d, fill: 'none', stroke: curve.colour, 'stroke-width': 0.8, 'stroke-opacity': 0.45 }));
        }
      }
      figure.each.append(view);
    }
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
    link(point[3], curve.owner);
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
    link('');
  }

  let eachShown = false;
  function show(figure) {
    figure.each.replaceChildren();
    if (eachShown) drawEach(figure);
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
    const drawing = decodeURIComponent(figure.image.src.slice(figure.image.src.indexOf(',') + 1));
    const parsed = new DOMParser().parseFromString(drawing, 'image/svg+xml');
    const svg = document.importNode(parsed.documentElement, true);
    for (const title of svg.querySelectorAll('title, desc')) title.remove();
    svg.setAttribute('role', 'img');
    svg.setAttribute('aria-label', figure.image.alt);
    svg.setAttribute('style', 'display: block; width: 100%; height: auto; background: #fff');
    svgSpace = svg.namespaceURI;
    const mark = drawn('circle', { r: 7, fill: 'none', stroke: '#444', 'stroke-width': 1.5 });
    const each = drawn('g', { class: 'each' }), linked = drawn('g', { class: 'linked' });
    mark.style.display = 'none';
    svg.append(each, linked, mark);
    const host = document.createElement('div');
    host.className = 'live';
    host.style.cssText = figure.image.style.cssText;
    host.attachShadow({ mode: 'open' }).append(svg);
    figure.image.replaceWith(host);
    Object.assign(figure, { svg, mark, each, linked });
    for (const type of ['pointermove', 'pointerdown']) host.addEventListener(type, (event) => look(figure, event));
    host.addEventListener('pointerleave', () => leave(figure));
    show(figure);
  }

  function dataOf(text) {
    const data = JSON.parse(text);
    for (const panel of data.panels)
      for (const curve of panel.curves)
        if (curve.ys) curve.points = curve.ys.map((y, k) => [panel.xs[curve.xs][k], y]);
    return data;
  }

  for (const source of document.querySelectorAll('figure script[type="application/json"]')) {
    const image = source.closest('figure').querySelector('img');
    if (image) figures.push({ image, data: dataOf(source.textContent) });
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

  const block = figures.find((figure) => figure.data.panels.some((panel) => panel.curves.some((curve) => curve.each)))
    ?.image.closest('.figures');
  if (block) {
    const tools = document.createElement('p');
    tools.className = 'tools';
    const each = button('lines of each packing', 'thin lines behind the means, in all plots that have them', () => {
      eachShown = !eachShown;
      each.setAttribute('aria-pressed', String(eachShown));
      update();
    });
    each.setAttribute('aria-pressed', 'false');
    tools.append(each);
    block.before(tools);
  }

  const legend = document.getElementById('legend');
  const entries = legend ? [...legend.querySelectorAll('span')] : [];
  const names = entries.map((entry) => entry.textContent);
  const all = button('show all', 'brings back what is hidden', () => {
    hidden.clear();
    update();
  });
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
  if (legend) {
    legend.append(all);
    update();
  }
})();
