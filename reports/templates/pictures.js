// Pictures of one packing by several engines, put in one place to step between them. Without this they
// stand side by side.
'use strict';
for (const block of document.querySelectorAll('.pictures')) {
  const figures = [...block.querySelectorAll(':scope > figure[data-engine]')];
  if (figures.length < 2) continue;
  const name = document.createElement('span'), range = document.createElement('input');
  Object.assign(range, { type: 'range', min: 0, max: figures.length - 1, value: 0, hidden: true });
  range.setAttribute('aria-label', 'engine');
  const show = () => {
    figures.forEach((figure, k) => figure.classList.toggle('shown', k === Number(range.value)));
    name.textContent = figures[range.value].dataset.engine;
    range.setAttribute('aria-valuetext', name.textContent);
  };
  range.addEventListener('input', show);
  const stack = button('in one place', 'one upon the other, to step between engines', () => {
    const on = block.classList.toggle('stacked');
    stack.setAttribute('aria-pressed', String(on));
    range.hidden = name.hidden = !on;
    show();
  });
  stack.setAttribute('aria-pressed', 'false');
  name.hidden = true;
  const tools = document.createElement('p');
  tools.className = 'tools';
  tools.append(stack, ' ', range, ' ', name);
  block.before(tools);
}
