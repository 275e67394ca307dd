// Tables that sort by a column, filter by words and copy as CSV, commands that copy, and folds that
// open for a link into them and for paper. Without this the pages lack nothing else.
'use strict';
(() => {
  function button(text, title, act) {
    const made = document.createElement('button');
    made.type = 'button';
    made.textContent = text;
    made.title = title;
    made.addEventListener('click', () => act(made));
    return made;
  }
  const MANY = 12;  // rows from which on a filter pays
  const RAISED = '⁰¹²³⁴⁵⁶⁷⁸⁹';

  async function copy(text, from) {
    const said = from.textContent;
    try {
      await navigator.clipboard.writeText(text);
      from.textContent = 'copied';
    } catch {
      from.textContent = 'cannot copy here';
    }
    setTimeout(() => { from.textContent = said; }, 1500);
  }

  // Text of a cell without its small print, which would make equal cells differ.
  function wordsOf(cell) {
    if (!cell) return '';
    const clone = cell.cloneNode(true);
    for (const small of clone.querySelectorAll('small, .anchor')) small.remove();
    for (const raised of clone.querySelectorAll('sup')) raised.replaceWith('^' + raised.textContent);
    return (clone.textContent.trim() || cell.textContent.trim()).replace(/\s+/g, ' ');
  }

  // 3.2 of "3.2 ± 0.4", −3e-4 of "−3×10⁻⁴"; absent where a cell begins otherwise.
  function numberOf(words) {
    const found = /^[✓✗~<>≤≥ ]*([−+-]?[\d.]+)(?:e([+-]?\d+)| ?× ?10(?:\^([−-]?\d+)|([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)))?/.exec(words);
    if (!found) return null;
    const plain = (text) => text.replace(/[−⁻]/, '-').replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (digit) => RAISED.indexOf(digit));
    const power = found[2] || found[3] || found[4];
    const value = Number(plain(found[1]) + (power ? 'e' + plain(power) : ''));
    return Number.isNaN(value) ? null : value;
  }

  // Numbers before words, what is absent (a dash) at the end whichever way.
  function compare(a, b, way) {
    if (a.absent !== b.absent) return a.absent ? 1 : -1;
    if (a.number !== null && b.number !== null) return way * (a.number - b.number);
    if ((a.number === null) !== (b.number === null)) return a.number === null ? 1 : -1;
    return way * a.words.localeCompare(b.words);
  }

  function sortBy(table, heads, column) {
    const way = heads[column].getAttribute('aria-sort') === 'ascending' ? -1 : 1;
    const body = table.tBodies[0];
    const rows = [...body.rows].map((row) => {
      const words = wordsOf(row.cells[column]);
      return { row, words, number: numberOf(words), absent: words === '' || words === '–' };
    });
    rows.sort((a, b) => compare(a, b, way));
    body.append(...rows.map((one) => one.row));
    heads.forEach((head) => head.removeAttribute('aria-sort'));
    heads[column].setAttribute('aria-sort', way > 0 ? 'ascending' : 'descending');
  }

  const quoted = (words) => (/[",\n]/.test(words) ? '"' + words.replaceAll('"', '""') + '"' : words);
  const csvOf = (table) =>
    [...table.rows].filter((row) => !row.hidden)
      .map((row) => [...row.cells].map((cell) => quoted(wordsOf(cell))).join(',')).join('\n') + '\n';

  // One body of rows with single cells below the heads, those of what failed fewer; others have groups, whose order says something.
  function isPlain(table) {
    if (table.tBodies.length !== 1 || !table.tHead || table.tHead.rows.length !== 1) return false;
    const columns = table.tHead.rows[0].cells.length;
    return [...table.rows].every((row) => row.cells.length <= columns && [...row.cells].every((cell) => cell.colSpan === 1 && cell.rowSpan === 1));
  }

  function addTools(table) {
    const tools = document.createElement('p');
    tools.className = 'tools';
    tools.append(button('copy as CSV', 'the rows that are shown', (from) => copy(csvOf(table), from)));
    if (isPlain(table) && table.tBodies[0].rows.length > 2) {
      const heads = [...table.tHead.rows[0].cells];
      heads.forEach((head, column) => {
        head.classList.add('sorts');
        head.tabIndex = 0;
        head.title = 'sorts; once more: the other way round';
        head.addEventListener('click', () => sortBy(table, heads, column));
        head.addEventListener('keydown', (event) => {
          if (event.key !== 'Enter' && event.key !== ' ') return;
          event.preventDefault();
          sortBy(table, heads, column);
        });
      });
      if (table.tBodies[0].rows.length >= MANY) {
        const filter = document.createElement('input');
        filter.type = 'search';
        filter.placeholder = 'rows with …';
        filter.setAttribute('aria-label', 'show only rows with these words');
        filter.addEventListener('input', () => {
          const wanted = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
          for (const row of table.tBodies[0].rows) {
            const words = row.textContent.toLowerCase();
            row.hidden = !wanted.every((word) => words.includes(word));
          }
        });
        tools.append(' ', filter);
      }
    }
    (table.closest('.scroll') || table).after(tools);
  }

  function openTo(id) {
    const target = id && document.getElementById(decodeURIComponent(id));
    if (!target) return;
    for (let at = target; at; at = at.parentElement) if (at.tagName === 'DETAILS') at.open = true;
    target.scrollIntoView();
  }
  addEventListener('hashchange', () => openTo(location.hash.slice(1)));
  addEventListener('click', (event) => {  // also of the link that was followed last
    const link = event.target.closest && event.target.closest('a[href^="#"]');
    if (link) openTo(link.hash.slice(1));
  });
  openTo(location.hash.slice(1));
  let folded = [];
  addEventListener('beforeprint', () => {
    folded = [...document.querySelectorAll('details:not([open])')];
    for (const details of folded) details.open = true;
  });
  addEventListener('afterprint', () => { for (const details of folded) details.open = false; });

  for (const table of document.querySelectorAll('table:not(.overview)')) addTools(table);
  for (const block of document.querySelectorAll('pre')) {
    const text = block.textContent;
    const tools = document.createElement('p');
    tools.className = 'tools';
    tools.append(button('copy', 'what is above', (from) => copy(text, from)));
    block.after(tools);
  }
})();
