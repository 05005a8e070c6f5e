// Opens the folded part that an address points into, opens everything for print, and filters the list of cases.
function reveal() {
  const at = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!at) return;
  for (let node = at; node; node = node.parentElement) if (node.tagName === 'DETAILS') node.open = true;
  at.scrollIntoView();
}
addEventListener('hashchange', reveal);
reveal();
addEventListener('beforeprint', () => document.querySelectorAll('details').forEach(d => { d.open = true; }));

const controls = document.getElementById('controls');
if (controls) {
  const [search, subject, state] = ['search', 'subject', 'state'].map(id => document.getElementById(id));
  const claims = JSON.parse(document.getElementById('claims').textContent);
  const found = document.getElementById('found');
  const most = 60;
  function listed(words, kind) {
    if (!words.length && !['disagrees', 'near', 'loose'].includes(kind)) return [];
    return claims.filter(([name, , quantity, mark]) => {
      const text = (name + ' ' + quantity).toLowerCase();
      const kept = !['disagrees', 'near', 'loose'].includes(kind) || mark === kind;
      return kept && words.every(word => text.includes(word));
    });
  }
  function show() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const hits = listed(words, state.value);
    const cases = new Set(hits.map(hit => hit[0]));
    document.querySelectorAll('section.subject').forEach(section => {
      let any = false;
      section.querySelectorAll('li[data-text]').forEach(row => {
        const name = row.querySelector('b').textContent;
        const text = words.every(word => row.dataset.text.includes(word)) || cases.has(name);
        const fits = !state.value || row.dataset.states.split(' ').includes(state.value);
        const same = !subject.value || section.dataset.subject === subject.value;
        row.hidden = !(text && fits && same);
        any = any || !row.hidden;
      });
      section.hidden = !any;
    });
    const list = found.querySelector('ul');
    list.textContent = '';
    hits.slice(0, most).forEach(([name, id, quantity]) => {
      const link = document.createElement('a');
      link.href = 'cases/' + name + '.html#' + id;
      link.textContent = name + ': ' + quantity;
      list.appendChild(document.createElement('li')).appendChild(link);
    });
    if (hits.length > most) list.appendChild(document.createElement('li')).textContent = 'and ' + (hits.length - most) + ' more';
    found.hidden = !hits.length;
  }
  controls.hidden = false;
  controls.addEventListener('submit', event => event.preventDefault());
  [search, subject, state].forEach(control => control.addEventListener('input', show));
  show();
}
