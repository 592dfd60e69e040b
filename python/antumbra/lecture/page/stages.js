// The kinds of stage that a reader moves: sliders, tabs, rays with their table, tables to sort; and the copied command.
$$('.strip').forEach(s => {
  const f = s.closest('.fig'), {key, tells, at} = s.dataset, range = $('input', s), output = $('output', s);
  const frames = $$('.frames > li', s), drawings = $$('.draws > svg', s), i = D.createElement('i');
  let moved = false;
  const show = n => {
    [frames, drawings].forEach(each => each.forEach((e, j) => toggle(e, 'on', j == n)));
    const {says, more, facts, term} = frames[n].dataset, [value, means] = says.split(/(:\s.*)/);
    range.value = n;
    i.textContent = means;
    output.replaceChildren(value, i);
    range.ariaValueText = f.classList.contains('told') ? says + (more || '') : value;
    if (term) $$('.hl', f).forEach((e, j) => toggle(e, 'off', j != term));
    [n - 1, n + 1].forEach(j => frames[j] && $$('img', frames[j]).forEach(m => m.loading = 'eager'));
    $$(`.key[data-of="${key}"] [data-i]`, f).forEach(e => e.textContent = JSON.parse(facts || '[]')[e.dataset.i]);
  };
  // Until somebody moves it, it stands where nothing is given away, then where the number is seen.
  const settle = () => show(moved ? +range.value : +(f.classList.contains('told') ? tells : at));
  range.oninput = () => { moved = true; settle(); set(f, key, frames[range.value].dataset.v) };
  const to = v => { const n = frames.findIndex(l => l.dataset.v == v); moved = n >= 0; if (moved) range.value = n; settle() };
  controls.push({f, key, to, settle});
});
$$('.tabbed').forEach(s => {
  const f = s.closest('.fig'), {key} = s.dataset, tabs = $$(':scope > .tabs > button', s), panels = $$(':scope > .pan', s);
  const show = n => {
    tabs.forEach((b, j) => { b.ariaSelected = j == n; b.tabIndex = j == n ? 0 : -1; panels[j].hidden = j != n });
    const curves = $$('.plot g[data-s]', f), chosen = g => g.dataset.s == tabs[n].dataset.v;
    if (curves.some(chosen)) curves.forEach(g => { toggle(g, 'on', chosen(g)); if (chosen(g)) g.parentNode.append(g) });
  };
  const pick = n => { show(n); tabs[n].focus(); set(f, key, tabs[n].dataset.v) };
  tabs.forEach((b, n) => {
    b.onclick = e => { pick(n); leave(e) };
    b.onkeydown = e => {
      const by = {ArrowRight: 1, ArrowLeft: -1}[e.key];
      if (by) { e.preventDefault(); pick((n + by + tabs.length) % tabs.length) }
    };
  });
  controls.push({f, key, to: v => show(Math.max(0, tabs.findIndex(b => b.dataset.v == v)))});
});
$$('.px').forEach(s => {
  const f = s.closest('.fig'), {key} = s.dataset, linked = $$('[data-j]', s);
  const hot = j => { toggle($('.scene svg', s), 'dim', j != null); linked.forEach(e => toggle(e, 'hot', e.dataset.j == j)) };
  linked.forEach(e => {
    const {j} = e.dataset;
    e.onmouseenter = () => hot(j);
    e.onmouseleave = () => hot(st.at == f.id ? st.kv[key] : null);
    e.addEventListener('focusin', () => hot(j));
    e.onclick = () => { hot(j); set(f, key, j) };
  });
  controls.push({f, key, to: hot});
});
// A table's rows by the column whose head is pressed: the largest first, pressed again the smallest.
$$('thead button').forEach(b => b.onclick = () => {
  const h = b.parentNode, t = h.closest('table'), up = h.ariaSort == 'descending';
  const at = r => parseFloat(r.cells[h.cellIndex].textContent.replace(/,/g, ''));
  $$('th', t).forEach(e => e.ariaSort = null);
  h.ariaSort = up ? 'ascending' : 'descending';
  t.tBodies[0].append(...$$('tbody tr', t).sort((p, q) => (at(p) - at(q)) * (up || -1)));
});
$$('.cmd button').forEach(b => b.onclick = async () => {
  const command = b.previousElementSibling;
  try { await navigator.clipboard.writeText(command.textContent); b.textContent = 'Copied' }
  catch (e) { getSelection().selectAllChildren(command); b.textContent = 'Selected' }
  say('Command ' + b.textContent.toLowerCase());
  setTimeout(() => b.textContent = 'Copy', 1600);
});
