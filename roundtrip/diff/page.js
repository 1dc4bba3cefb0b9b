'use strict';
const rows = [...document.querySelectorAll('.differences li')];
let at = -1;

function show(line) {
  if (!line) return;
  const details = line.closest('details');
  if (details) details.open = true;
  line.classList.add('on');
  line.scrollIntoView({block: 'center'});
}

function select(number) {
  if (number < 0 || number >= rows.length) return;
  for (const each of document.querySelectorAll('.on')) each.classList.remove('on');
  at = number;
  const row = rows[at];
  for (const side of [row.dataset.left, row.dataset.right]) show(document.getElementById(side));
  row.classList.add('on');
  row.scrollIntoView({block: 'nearest'});
  history.replaceState(null, '', '#' + row.id);
}

function open(address) {
  const number = rows.findIndex((row) => '#' + row.id === address);
  select(number < 0 ? 0 : number);
}

rows.forEach((row, number) => row.addEventListener('click', (event) => {
  event.preventDefault();
  select(number);
}));
document.addEventListener('keydown', (event) => {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  const step = {j: 1, ArrowDown: 1, k: -1, ArrowUp: -1}[event.key];
  if (!step) return;
  event.preventDefault();
  select(at + step);
});
addEventListener('hashchange', () => open(location.hash));
document.documentElement.classList.add('js');
open(location.hash);
