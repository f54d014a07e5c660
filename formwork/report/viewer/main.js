// Puts the page together: one state (shape, colour, chosen panel), shown by the view, the card, the sheet and the table.
(() => {
  const {element, show} = Page, raw = Data.raw, byId = id => document.getElementById(id);
  const summary = raw.summary && typeof raw.summary === 'object' ? raw.summary : null;
  const scene = raw.scene && typeof raw.scene === 'object' ? raw.scene : null;
  let view = null;

  Page.theme();
  Page.keyFigures(summary);
  Page.comparison(summary && summary.sew);
  Page.figureTables(summary);
  Page.convergencePlots(raw.convergence);
  Page.pictures(raw.pictures);
  const said = key => Object.values(summary || {}).flatMap(s => s && Array.isArray(s[key]) ? s[key] : []);
  Page.model(scene, [...said('violations').map(v => 'Bound not met: ' + v), ...said('warnings'), ...raw.notes]);
  Page.scene(raw.scene);
  byId('made-by').textContent = `Made by formwork ${raw.version}. Lengths in mm, liquid in litres; everything else carries its unit.`;

  const showSeam = seam => { if (view) view.setSeam(seam); };
  function choose(panels, seam = -1) {
    if (view) view.setChosen(panels);
    showSeam(seam);
    for (const node of document.querySelectorAll('[data-panel]')) node.classList.toggle('chosen', panels.includes(Number(node.dataset.panel)));
    const first = panels.length === 1 ? Data.panels.find(p => p.id === panels[0]) : null;
    Flat.card(byId('panel-card'), first, Data.panels, first ? Data.neighbours[panels[0]] : [], choose, showSeam);
  }

  function legend(field) {
    const box = byId('legend');
    box.replaceChildren();
    if (!field) return;
    const of = Data.shapes.find(s => s.key === field.of);
    box.append(element('div', {}, field.title + (field.unit && field.unit !== '-' ? ', ' + field.unit : '')));
    if (of) box.append(element('div', {class: 'kind'}, `of the ${of.name.toLowerCase()} bag`));
    if (field.classes.length) {
      field.classes.forEach((name, i) => box.append(element('div', {class: 'swatch'}, element('i',
          {style: `background:rgb(${View.classColours[i].map(v => Math.round(255 * v)).join()})`}), name)));
      return;
    }
    const stops = Array.from({length: 17}, (_, i) => `rgb(${View.colourOfMap(field.map, i / 16).map(v => Math.round(255 * v)).join()})`);
    const ticks = element('div', {class: 'ticks'}), range = field.high - field.low;
    const power = 10 ** Math.floor(Math.log10(range / 5)), step = power * [1, 2, 5, 10].find(m => range / (m * power) <= 6);
    for (let k = Math.ceil(field.low / step - 1e-6); k * step <= field.high + 1e-6 * step; ++k)
      ticks.append(element('span', {style: `bottom:${100 * (k * step - field.low) / range}%`}, show(Number((k * step).toPrecision(6)))));
    box.append(element('div', {class: 'bar'}, element('div', {class: 'ramp', style: `background:linear-gradient(to top,${stops.join()})`}), ticks));
  }

  // How the area is spread over the values: bars in the colours of the bag, and the numbers behind them.
  function distribution(field) {
    const box = byId('distribution');
    box.replaceChildren();
    if (!field) return;
    const values = Array.from(Data.areas, (_, f) => Data.ofFace(field, f)), total = Data.areas.reduce((s, a) => s + a, 0) || 1;
    if (field.classes.length) {
      box.append(element('p', {class: 'kind'}, field.classes.map((name, i) =>
          `${name} ${show(100 * values.reduce((s, v, f) => s + (Math.round(v) === i ? Data.areas[f] : 0), 0) / total, 3)} %`).join(' · ') + ' of the area'));
      return;
    }
    const bins = new Float64Array(40), range = field.high - field.low, order = values.map((_, f) => f).sort((p, q) => values[p] - values[q]);
    values.forEach((v, f) => { bins[Math.min(39, Math.max(0, Math.floor(40 * (v - field.low) / range)))] += Data.areas[f]; });
    const top = Math.max(...bins), w = 270, h = 70, drawing = Page.svg('svg', {viewBox: `0 0 ${w} ${h}`, role: 'img', 'aria-label': 'Share of the area over the values'});
    bins.forEach((b, i) => drawing.append(Page.svg('rect', {x: i * w / 40, width: w / 40 - 0.6, y: h - h * b / top, height: h * b / top,
        fill: `rgb(${View.colourOfMap(field.map, (i + 0.5) / 40).map(v => Math.round(255 * v)).join()})`})));
    const at = share => { let sum = 0; for (const f of order) { sum += Data.areas[f]; if (sum >= share * total) return values[f]; } return values[order[order.length - 1]]; };
    const mean = values.reduce((s, v, f) => s + v * Data.areas[f], 0) / total;
    box.append(drawing, element('div', {class: 'ends'}, element('span', {}, show(field.low, 3)), element('span', {}, show(field.high, 3))),
               element('p', {class: 'kind'}, `by area: mean ${show(mean, 3)}, 5 to 95 %: ${show(at(0.05), 3)} to ${show(at(0.95), 3)}, largest ${show(values[order[order.length - 1]], 3)}`));
  }

  function hover(hit) {
    const out = [], field = Data.fields.find(f => f.key === byId('colour-by').value);
    if (hit) {
      if (Data.panelOfFace) out.push(`panel ${Data.panels[Data.panelOfFace[hit.face]].name}`);
      if (field) {
        const v = Data.ofFace(field, hit.face);
        out.push(field.classes.length ? field.classes[Math.round(v)] : `${field.title} ${show(v, 4)} ${field.unit === '-' ? '' : field.unit}`);
      }
    }
    byId('readout').textContent = out.join(' · ');
  }

  function setShape(key, at_once) {
    view.setShape(key, at_once);
    for (const b of byId('shapes').querySelectorAll('button')) b.setAttribute('aria-pressed', String(b.dataset.shape === key));
  }
  function setField(key) {
    byId('colour-by').value = key;
    view.setField(key);
    const field = Data.fields.find(f => f.key === key);
    legend(field);
    distribution(field);
    const names = byId('show-tag');   // the colours of panels mean nothing without their names
    if (names && names.checked !== (key === 'panel')) names.click();
  }

  function threeDimensional() {
    if (!Data.faces.length) return;
    byId('view').hidden = false;
    try {
      view = View.create(byId('canvas-box'), {click: panel => choose(panel >= 0 ? [panel] : []), hover, key: i => Data.shapes[i] && setShape(Data.shapes[i].key)});
    } catch (error) {
      byId('canvas-box').replaceChildren(element('p', {class: 'warning'}, 'The 3-D view needs WebGL, which this browser does not offer. The pictures below show the same.'));
      return;
    }
    for (const s of Data.shapes)
      byId('shapes').append(element('button', {type: 'button', 'data-shape': s.key, 'aria-pressed': 'false', onclick: () => setShape(s.key)}, s.name));
    const select = byId('colour-by');
    if (Data.panelOfFace) select.append(element('option', {value: 'panel'}, 'panels'));
    for (const s of Data.shapes) {
      const own = Data.fields.filter(f => f.of === s.key);
      if (own.length) select.append(element('optgroup', {label: `${s.name} bag`}, ...own.map(f =>
          element('option', {value: f.key}, f.title + (f.unit && f.unit !== '-' ? ', ' + f.unit : '')))));
    }
    if (!select.options.length) select.append(element('option', {value: 'panel'}, 'plain'));
    select.addEventListener('change', () => setField(select.value));
    const toggle = (name, label, on) => {
      const input = element('input', {type: 'checkbox', id: 'show-' + name});
      input.checked = on;
      input.addEventListener('change', () => view.setVisible(name, input.checked));
      byId('toggles').append(element('label', {class: 'check'}, input, label));
      view.setVisible(name, on);
    };
    if (Data.seams.length) toggle('seams', 'seams and rims', true);
    if (view.hasCross) toggle('cross', 'cross field', false);
    if (Data.singularities.length) toggle('mark', 'singularities, by valence', true);
    if (Data.labelFaces.length) toggle('tag', 'names of the panels', false);
    if (!byId('toggles').querySelector('input')) byId('toggles').hidden = true;
    byId('save-view').addEventListener('click', () => element('a', {href: view.picture(), download: 'view.png'}).click());
    const has = key => Data.shapes.some(s => s.key === key);
    setShape(has('inflated') ? 'inflated' : 'rest', true);
    const first = Data.fields.find(f => f.key === 'inflated-lambda1');
    setField(first ? first.key : select.options[0].value);
  }

  if (Data.panels.some(p => p.outline)) {
    byId('flat').hidden = false;
    byId('flat-note').textContent = 'Sewing lines, at one scale, seen from outside; arrows are the warp. The files to cut from, with allowance and marks, lie in the panels folder beside this report.';
    let width = 0;
    new ResizeObserver(() => {
      const w = byId('flat-sheet').clientWidth;
      if (Math.abs(w - width) < 8) return;
      width = w;
      Flat.sheet(byId('flat-sheet'), Data.panels, choose);
    }).observe(byId('flat-sheet'));
    Flat.table(byId('panel-table'), Data.panels, Data.neighbours, choose);
  }
  if (raw.sewing.length) {
    byId('sewing').hidden = false;
    for (const s of raw.sewing)
      byId('sewing-steps').append(element('li', {}, s.panels.length ?
          element('button', {type: 'button', onclick: () => { choose(s.panels, s.seam); byId('view').scrollIntoView({block: 'nearest'}); }}, s.text) : s.text));
  }
  threeDimensional();
  choose([]);
})();
