// Slides: head, chapters and figures are stops, a figure has five steps; then what the address says is shown.
const NAMES = ['question', 'pictures', 'number', 'equation', 'claims'];
const asks = s => 'asks' in s.dataset, last = s => s.matches('.fig') ? NAMES.length - 1 : 0;
const now = () => Math.max(0, stops.findIndex(s => s.id == st.at));
const show = () => {
  toggle(D.body, 'slides', st.slides);
  press($('#b-slides'), st.slides);
  stops.forEach(s => s.className = s.className.replace(/\s(cur|s\d)\b/g, ''));
  // A question about pictures stands with them.
  const s = stops[now()];
  if (st.slides) s.classList.add('cur', 's' + (st.step || +asks(s)));
  D.body.dataset.pos = now() + 1 + ' / ' + stops.length;
  figures.forEach(settle); fit();
};
const go = (n, step = 0) => {
  const s = stops[n];
  if (!s) return;
  move(s.id);
  st.step = step;
  if (step) st.kv.step = step; else delete st.kv.step;
  write(); show();
  say($('h1,h2,h3', s).textContent + (last(s) ? ', ' + NAMES[step] : ''));
};
const step = by => {
  const n = now(), s = stops[n], to = st.step + by;
  if (to < 0) n && go(n - 1, last(stops[n - 1]));
  else if (to > last(s)) go(n + 1);
  else go(n, to == 1 && asks(s) ? to + by : to);
};
const slides = on => {
  st.slides = on;
  if (on) return go(now());
  delete st.kv.step;
  write(); show();
  stops[now()].scrollIntoView();
};
$('#b-slides').onclick = () => { move(stops.find(s => s.getBoundingClientRect().bottom > 200)?.id || st.at); slides(true) };
$('#b-exit').onclick = () => slides(false);
$('#b-print').onclick = () => print();
addEventListener('click', e => { if (st.slides && !e.target.closest('button,a,input,label,[data-j]')) step(1) });
const KEYS = {
  ArrowRight: () => step(1), ArrowLeft: () => step(-1), PageDown: () => step(1), PageUp: () => step(-1),
  ArrowDown: () => go(now() + 1), ArrowUp: () => go(now() - 1), Home: () => go(0), End: () => go(stops.length - 1),
  ' ': e => step(e.shiftKey ? -1 : 1), Escape: () => slides(false),
};
addEventListener('keydown', e => {
  const {key, target} = e;
  if (!st.slides || e.altKey || e.ctrlKey || e.metaKey || !KEYS[key]) return;
  // A focused slider keeps its keys, a tab ← and →, another button its space.
  const own = {INPUT: /^(Arrow|Home|End)/, BUTTON: target.role ? /Left|Right/ : /\s/}[target.tagName];
  if (own?.test(key)) return;
  e.preventDefault();
  KEYS[key](e);
});

// Equations shrink to their column; a table that goes on says so.
const fit = () => {
  $$('.eq').forEach(e => {
    const m = $('.m', e);
    if (!m) return;
    m.style.fontSize = '';
    const share = e.clientWidth / e.scrollWidth;
    if (share < 1) m.style.fontSize = Math.max(50, 98 * share | 0) + '%';
  });
  $$('.scroll').forEach(e => toggle(e, 'more', e.scrollWidth > e.clientWidth));
};
const apply = () => {
  const nowhere = read();
  if (st.slides && !st.at) st.at = stops[0].id;
  st.step = Math.min(last(stops[now()]), Math.max(0, +st.kv.step || 0));
  controls.forEach(c => c.to(c.f.id == st.at ? st.kv[c.key] : undefined));
  if (st.kv.answers || pressed(all)) { answers(true); write() }
  show();
  say(nowhere && `There is no figure “${nowhere}”.`, nowhere);
  if (st.at && !st.slides) stops[now()].scrollIntoView();
};
addEventListener('resize', fit);
addEventListener('hashchange', apply);
apply();

// The chapter in view is marked in the bar.
const links = $$('.bar nav a');
const seen = new IntersectionObserver(all => all.filter(e => e.isIntersecting).forEach(e => links.forEach(a => {
  a.ariaCurrent = a.hash == '#' + e.target.dataset.ch || null;
})), {rootMargin: '-20% 0px -70%'});
$$('[data-ch]').forEach(s => seen.observe(s));
