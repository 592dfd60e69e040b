// What is seen, the address that says it, and which figures are answered.
const D = document, H = D.documentElement;
const $ = (s, e = D) => e.querySelector(s), $$ = (s, e = D) => [...e.querySelectorAll(s)];
const toggle = (e, name, on) => e.classList.toggle(name, on), press = (e, on) => e.ariaPressed = on;
const pressed = e => e.ariaPressed == 'true';
H.classList.add('js');

// `at`: the id of a figure, of a chapter or of the head; `step` of its slide; `kv`: the rest of the address.
const st = {at: '', kv: {}, slides: false, step: 0};
const figures = $$('.fig'), stops = $$('.head,.ch,.fig');
// Of each control: its figure and key, `to` a value of the address, and `settle` when the figure's answer comes or goes.
const controls = [], opened = new Set();

// Said to the ear; a problem is also seen.
const say = (text, problem) => { const live = $('#live'); toggle(live, 'sr', !problem); live.textContent = text };

const decoded = x => { try { return decodeURIComponent(x) } catch (e) { return x } };
// Takes the state from the address; gives a name in it that nothing here has.
const read = () => {
  const parts = location.hash.slice(1).split('/').filter(Boolean).map(decoded), slides = parts[0] == 'slides';
  if (slides) parts.shift();
  st.slides = slides && innerWidth > 820;
  const name = /=|^answers$/.test(parts[0]) ? '' : parts.shift() || '';
  st.at = stops.some(s => s.id == name) ? name : '';
  st.kv = {};
  parts.forEach(x => { const [k, ...v] = x.split('='); if (v[0] || k == 'answers') st.kv[k] = v.join('=') || '1' });
  return st.at ? '' : name;
};
const write = () => {
  const kv = Object.entries(st.kv).map(([k, v]) => k == 'answers' ? k : k + '=' + encodeURIComponent(v));
  history.replaceState(null, '', '#' + [st.slides ? 'slides' : '', st.at, ...kv].filter(Boolean).join('/'));
};
// What the address says of another figure goes; that all are answered stays.
const move = at => { if (st.at != at) { const {answers} = st.kv; st.at = at; st.kv = answers ? {answers} : {} } };
const set = (f, k, v) => { move(f.id); st.kv[k] = v; write() };

const dark = $('#b-theme'), theme = t => { H.dataset.theme = t; press(dark, t == 'dark') };
const stored = t => { try { return t ? localStorage.theme = t : localStorage.theme } catch (e) { return t } };
theme(stored() || (matchMedia('(prefers-color-scheme:dark)').matches ? 'dark' : 'light'));
dark.onclick = () => theme(stored(pressed(dark) ? 'light' : 'dark'));

// Paper has all answers, on slides the third step answers, else the reader does.
const paper = matchMedia('print');
const settle = f => {
  toggle(f, 'told', paper.matches || (st.slides ? f.id == st.at && st.step > 1 : opened.has(f)));
  controls.forEach(c => c.f == f && c.settle?.());
};
// Pressed with the mouse on a slide, a choice or a tab gives the keys back to the slides.
const leave = e => { if (st.slides && e.detail) e.currentTarget.blur() };
const open = (f, on = true) => {
  on ? opened.add(f) : opened.delete(f);
  $('.ask button', f).ariaExpanded = on;
  settle(f);
};
// A choice answers, and so does none: then only the right one is said.
const answer = (f, choice) => {
  const right = $('[data-ok]', f), rest = right ? `Right: ${right.textContent}. ` : 'This run leaves it open. ';
  $$('.q button', f).forEach(b => press(b, b == choice));
  $('.verdict', f).textContent = (!right || !choice ? rest : choice == right ? 'Yes. ' : 'Not so. ' + rest) + 'The number is below.';
  open(f); fit();
};
paper.onchange = () => figures.forEach(settle);
figures.forEach(f => {
  $('.ask button', f).onclick = () => { answer(f); $('.ans', f).focus() };
  $$('.q button', f).forEach(b => b.onclick = e => { answer(f, b); leave(e) });
});
// As long as the button is pressed, the address says it.
const all = $('#b-answers'), answers = on => {
  figures.forEach(f => open(f, on));
  press(all, on);
  if (on) st.kv.answers = '1'; else delete st.kv.answers;
};
all.onclick = () => { answers(!pressed(all)); fit(); write() };
