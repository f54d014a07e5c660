// The flat pieces: one sheet with all of them at one scale, and a single piece for the panel card. Warp points up.
const Flat = (() => {
  const {element, svg, show} = Page;

  function drawn(panel) {   // mm, y down
    const points = panel.outline.map(([u, v]) => [-v, -u]);
    const xs = points.map(p => p[0]), ys = points.map(p => p[1]);
    const x0 = Math.min(...xs), y0 = Math.min(...ys);
    return {points, x0, y0, w: Math.max(...xs) - x0, h: Math.max(...ys) - y0};
  }

  function inside(points, x, y) {
    let odd = false;
    for (let i = 0, j = points.length - 1; i < points.length; j = i++) {
      const [xi, yi] = points[i], [xj, yj] = points[j];
      if ((yi > y) !== (yj > y) && x < (xj - xi) * (y - yi) / (yj - yi) + xi) odd = !odd;
    }
    return odd;
  }

  // The place farthest from the outline, on a grid: room for the number and the grain arrow.
  function roomiest(d) {
    let best = [d.x0 + d.w / 2, d.y0 + d.h / 2], depth = -1;
    const middle = best;
    for (let i = 1; i < 20; ++i)
      for (let j = 1; j < 20; ++j) {
        const x = d.x0 + d.w * i / 20, y = d.y0 + d.h * j / 20;
        if (!inside(d.points, x, y)) continue;
        let near = Infinity;
        for (const p of d.points) near = Math.min(near, (p[0] - x) ** 2 + (p[1] - y) ** 2);
        near = Math.sqrt(near) - 0.15 * Math.hypot(x - middle[0], y - middle[1]);
        if (near > depth) { depth = near; best = [x, y]; }
      }
    return {x: best[0], y: best[1]};
  }

  function piece(panel, d, dx, dy, letter) {
    const path = 'M' + d.points.map(p => (p[0] + dx).toFixed(2) + ' ' + (p[1] + dy).toFixed(2)).join('L') + 'Z';
    const at = roomiest(d), size = Math.min(letter, 0.3 * d.w, 0.3 * d.h), a = Math.min(0.16 * d.h, 2 * size), head = 0.35 * size;
    const x = at.x + dx, y = at.y + dy - 0.6 * size;
    const line = (x1, y1, x2, y2) => svg('line', {x1, y1, x2, y2});
    return svg('g', {class: 'piece', 'data-panel': panel.id, tabindex: 0, role: 'button', 'aria-label': `Panel ${panel.name}`},
        svg('path', {d: path, fill: `color-mix(in srgb, ${panel.colour} 72%, white)`}),
        svg('text', {x, y: y + a + 1.05 * size, 'font-size': size, 'text-anchor': 'middle'}, panel.name),
        line(x, y + a, x, y - a), line(x, y - a, x - head, y - a + head), line(x, y - a, x + head, y - a + head));
  }

  function rows(boxes, width, gap) {
    let x = 0, y = 0, row = 0, used = 0;
    const places = boxes.map(b => {
      if (x > 0 && x + b.w > width) { x = 0; y += row + gap; row = 0; }
      const place = [x, y];
      used = Math.max(used, x + b.w);
      x += b.w + gap;
      row = Math.max(row, b.h);
      return place;
    });
    return {places, w: used, h: y + row};
  }

  function roundLength(mm) {
    const p = 10 ** Math.floor(Math.log10(mm));
    return [5, 2, 1].find(m => m * p <= mm) * p;
  }

  function sheet(box, panels, choose) {
    const shown = panels.filter(p => p.outline && p.outline.length > 2);
    box.replaceChildren();
    if (!shown.length) return;
    const boxes = shown.map(drawn), longest = Math.max(...boxes.map(b => Math.max(b.w, b.h))), gap = 0.05 * longest;
    const aspect = Math.min(2.2, Math.max(0.6, box.clientWidth / 520));
    const area = boxes.reduce((s, b) => s + (b.w + gap) * (b.h + gap), 0);
    let best = null;
    for (let k = 4; k <= 40; ++k) {
      const r = rows(boxes, Math.sqrt(area * aspect) * k / 16, gap), size = Math.max(r.w / aspect, r.h);
      if (!best || size < best.size) best = {...r, size};
    }
    const unit = best.w / Math.max(box.clientWidth, 300), letter = 18 * unit, pad = 14 * unit, foot = 46 * unit;
    const drawing = svg('svg', {viewBox: `${-pad} ${-pad} ${best.w + 2 * pad} ${best.h + 2 * pad + foot}`, role: 'group', 'aria-label': 'All pieces at one scale'});
    shown.forEach((p, i) => drawing.append(piece(p, boxes[i], best.places[i][0] - boxes[i].x0, best.places[i][1] - boxes[i].y0, letter)));
    const bar = roundLength(best.w * 0.3), y = best.h + 0.7 * foot;
    drawing.append(svg('g', {class: 'scale'}, svg('line', {x1: 0, x2: bar, y1: y, y2: y}),
        svg('line', {x1: 0, x2: 0, y1: y - 5 * unit, y2: y + 5 * unit}), svg('line', {x1: bar, x2: bar, y1: y - 5 * unit, y2: y + 5 * unit}),
        svg('text', {x: bar + 8 * unit, y: y + 5 * unit, 'font-size': 14 * unit}, show(bar) + ' mm')));
    for (const g of drawing.querySelectorAll('.piece')) {
      const id = Number(g.dataset.panel);
      g.addEventListener('click', () => choose([id]));
      g.addEventListener('keydown', e => { if (e.key === 'Enter' || e.key === ' ') { e.preventDefault(); choose([id]); } });
    }
    box.append(drawing);
  }

  function card(box, panel, panels, neighbours, choose, showSeam) {
    box.replaceChildren();
    if (!panel) { box.append(element('p', {class: 'kind'}, 'Click a panel to see its piece and its neighbours.')); return; }
    box.append(element('h3', {}, `Panel ${panel.name}`));
    if (panel.outline && panel.outline.length > 2) {
      const d = drawn(panel), pad = 0.04 * Math.max(d.w, d.h);
      box.append(svg('svg', {viewBox: `${-pad} ${-pad} ${d.w + 2 * pad} ${d.h + 2 * pad}`},
                     piece(panel, d, -d.x0, -d.y0, 0.09 * Math.max(d.w, d.h))));
      const entry = (name, v) => [element('dt', {}, name), element('dd', {}, v)];
      box.append(element('dl', {}, ...entry('size', `${show(d.w, 3)} × ${show(d.h, 3)} mm`), ...entry('cloth', `${show(panel.area * 1e4, 3)} cm²`),
                         ...entry('distortion, largest', `${show(100 * panel.max_distortion, 2)} %`),
                         ...entry('grain off strain', `${show(panel.grain_deviation_deg, 2)}°`)));
    }
    if (neighbours.length) {
      box.append(element('p', {class: 'kind'}, 'Its seams, and where they lead'));
      box.append(element('div', {class: 'neighbours'}, ...neighbours.map(n => {
        const text = `${n.name}${n.panel < 0 ? ' (rim)' : ' to ' + panels[n.panel].name} · ${show(1000 * n.length, 3)} mm`;
        const see = () => showSeam(n.seam), leave = () => showSeam(-1);
        return element('button', {type: 'button', 'data-neighbour': n.panel, onmouseenter: see, onfocus: see, onmouseleave: leave, onblur: leave,
                                  onclick: () => n.panel >= 0 && choose([n.panel])}, text);
      })));
    }
    box.append(element('p', {}, element('button', {type: 'button', onclick: () => choose([])}, 'Show all panels')));
  }

  function table(box, panels, neighbours, choose) {
    if (!panels.some(p => p.outline)) return;
    const head = ['Panel', 'Size, mm', 'Cloth, cm²', 'Distortion, %', 'Grain off strain, °', 'Sewn to'];
    const body = element('tbody');
    for (const p of panels) {
      if (!p.outline) continue;
      const d = drawn(p);
      const cell = text => element('td', {class: 'number'}, text);
      body.append(element('tr', {'data-panel': p.id},
          element('td', {}, element('button', {type: 'button', onclick: () => choose([p.id])}, p.name)),
          cell(`${show(d.w, 3)} × ${show(d.h, 3)}`), cell(show(1e4 * p.area, 3)), cell(show(100 * p.max_distortion, 2)),
          cell(show(p.grain_deviation_deg, 2)), element('td', {}, [...new Set(neighbours[p.id].filter(n => n.panel >= 0).map(n => panels[n.panel].name))].join(', '))));
    }
    box.append(element('table', {}, element('thead', {}, element('tr', {}, ...head.map((h, i) =>
        element('th', {class: i && i < 5 ? 'number' : ''}, h)))), body));
  }
  return {sheet, card, table};
})();
