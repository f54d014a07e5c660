// Figures, convergence, model and scene: everything that is text, tables and small charts.
const Page = (() => {
  function element(tag, attributes = {}, ...children) {
    const node = document.createElement(tag);
    for (const [k, v] of Object.entries(attributes)) {
      if (k.startsWith('on')) node.addEventListener(k.slice(2), v);
      else if (v !== undefined && v !== null) node.setAttribute(k, v);
    }
    node.append(...children);
    return node;
  }
  function svg(tag, attributes = {}, ...children) {
    const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [k, v] of Object.entries(attributes)) node.setAttribute(k, v);
    node.append(...children);
    return node;
  }

  function show(value, digits = 4) {
    if (typeof value === 'boolean') return value ? 'yes' : 'no';
    if (typeof value !== 'number') return String(value);
    if (!Number.isFinite(value)) return '–';
    if (Number.isInteger(value) && Math.abs(value) < 1e7) return String(value).replace('-', '\u2212');
    const size = Math.abs(value);
    const text = size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(Math.max(0, digits - 2))
                                                            : String(Number(value.toPrecision(digits)));
    return text.replace(/-/g, '\u2212').replace('e+', 'e');
  }

  // What the keys of summary.json are called here; [name, unit, factor]. Others get their unit from their ending.
  const names = {
    converged: ['Converged'], residual: ['Residual, relative to the load'], iterations: ['Iterations'],
    factorizations: ['Factorisations'], vertices: ['Vertices'], faces: ['Faces'], free_dofs: ['Free degrees of freedom'],
    wall_s: ['Time', 's'], cpu_s: ['Processor time', 's'], peak_rss_mb: ['Memory, peak', 'MB'],
    fill_level_m: ['Fill level', 'mm', 1e3], depth_m: ['Depth below the level', 'mm', 1e3],
    depth_below_rim_m: ['Depth below the rim', 'mm', 1e3], volume_m3: ['Liquid', 'litres', 1e3],
    capacity_m3: ['Capacity up to the rim', 'litres', 1e3], liquid_mass_kg: ['Mass of the liquid', 'kg'],
    support_force_N: ['Force on the supports', 'N'], max_stretch: ['Largest stretch \u03bb\u2081'],
    min_stretch: ['Smallest stretch \u03bb\u2082'], wrinkled_faces: ['Wrinkled faces'], slack_faces: ['Slack faces'],
    method: ['Method'], mean_abs_shear: ['Mean |shear| \u03b5_uv'], max_abs_shear: ['Largest |shear| \u03b5_uv'],
    min_cos_weave_angle: ['Cosine of the weave angle, smallest'], max_cos_weave_angle: ['Cosine of the weave angle, largest'],
    shape_rms_m: ['Deviation from the cut surface, RMS', 'mm', 1e3], shape_max_m: ['Deviation from the cut surface, largest', 'mm', 1e3],
    inflated_rms_m: ['Deviation from the inflated shape, RMS', 'mm', 1e3], max_tension_N_per_m: ['Largest tension', 'N/m'],
    seam_max_force_N: ['Largest seam force', 'N'], panels: ['Panels'], count: ['Pieces'], index_sum: ['Sum of the indices'],
    boundary_turning: ['Boundary turning'], euler_characteristic: ['Euler characteristic'],
    smoothness_energy: ['Smoothness energy'], alignment_energy: ['Alignment energy'],
    field_deviation_deg: ['Field against strain, mean', '\u00b0'], seam_length_m: ['Seam length', 'm'],
    all_disks: ['Every panel is a disk'], cloth_area_m2: ['Cloth', 'm\u00b2'], rest_area_m2: ['Surface', 'm\u00b2'],
    max_stretch_distortion: ['Distortion of the flattening, largest', '%', 100],
    mean_stretch_distortion: ['Distortion of the flattening, mean', '%', 100], flips: ['Flipped faces'],
    overlaps: ['Overlapping pieces'], max_seam_length_mismatch: ['Seam length mismatch, largest', '%', 100],
    max_panel_covariance_energy: ['Panel covariance energy, largest'], files: ['Files'],
    rounding_floor: ['Residual that rounding alone leaves'], p95_abs_shear: ['|shear| below which 95 % of the cloth lies'],
    taut_mean_abs_shear: ['Mean |shear| where the cloth is taut'], inflated_max_m: ['Deviation from the inflated shape, largest', 'mm', 1e3],
    p95_tension_N_per_m: ['Tension below which 95 % of the cloth lies', 'N/m'],
    seam_max_line_load_N_per_m: ['Largest pull across a seam', 'N/m'], warp_strain: ['Warp strain'], weft_strain: ['Weft strain'],
    area_share_per_5deg_off_square: ['Cloth by the weave\u2019s angle off square, in steps of 5\u00b0', '%', 100],
    prestress_N_per_m: ['Prestress', 'N/m'], depth_effect: ['Effect on the depth', '%', 100], volume_effect: ['Effect on the volume', '%', 100],
    residual_stiffness: ['Residual stiffness'], regularisation: ['Regularisation'], p95: ['95 % below'], min: ['Smallest'], max: ['Largest'],
    roll_length_m: ['Length of the roll', 'm'], roll_utilisation: ['Share of the roll used', '%', 100],
  };
  const endings = [['_N_per_m', 'N/m'], ['_m3', 'm\u00b3'], ['_m2', 'm\u00b2'], ['_deg', '\u00b0'], ['_kg', 'kg'], ['_mb', 'MB'],
                   ['_mm', 'mm'], ['_N', 'N'], ['_m', 'm'], ['_s', 's'], ['_Pa', 'Pa']];
  function describe(key) {
    if (names[key]) return {name: names[key][0], unit: names[key][1] || '', factor: names[key][2] || 1};
    const ending = endings.find(e => key.endsWith(e[0]));
    const words = (ending ? key.slice(0, -ending[0].length) : key).replace(/_/g, ' ');
    return {name: words.charAt(0).toUpperCase() + words.slice(1), unit: ending ? ending[1] : '', factor: 1};
  }
  function value(v, about) {
    if (Array.isArray(v)) {   // a component that is rounding noise beside the others is 0
      const top = Math.max(...v.map(x => typeof x === 'number' ? Math.abs(x) : 0));
      return v.map(x => value(typeof x === 'number' && Math.abs(x) < 1e-9 * top ? 0 : x, about)).join(', ');
    }
    return typeof v === 'number' ? show(v * about.factor) : show(v);
  }

  const hidden = ['residual_history', 'violations', 'warnings', 'compare'];   // shown elsewhere
  const stageNames = {inflate: 'Inflated bag', segment: 'Segmentation', panels: 'Panels', sew: 'Sewn bag'};
  function rows(object, body, prefix = '') {
    for (const [key, v] of Object.entries(object)) {
      if (v === null || hidden.includes(key)) continue;
      const about = describe(key.replace(/^-(?=\d)/, '\u2212')), name = prefix ? prefix + ': ' + about.name.toLowerCase() : about.name;
      if (typeof v === 'object' && !Array.isArray(v)) {
        rows(v, body, name);
      } else if (!Array.isArray(v) || (v.length && v.length < 12 && typeof v[0] !== 'object')) {
        body.append(element('tr', {title: key}, element('td', {class: 'what'}, name),
                            element('td', {class: 'number'}, (value(v, about) + (about.unit ? '\u00a0' + about.unit : '')))));
      }
    }
  }
  function figureTables(summary) {
    const box = document.getElementById('figure-tables');
    if (!summary || typeof summary !== 'object') return;
    const order = ['inflate', 'segment', 'panels', 'sew'];
    const keys = Object.keys(summary).sort((a, b) => (order.indexOf(a) + 5) % 5 - (order.indexOf(b) + 5) % 5);
    const loose = {};
    for (const key of keys) {
      if (summary[key] === null || typeof summary[key] !== 'object' || Array.isArray(summary[key])) { loose[key] = summary[key]; continue; }
      const body = element('tbody');
      rows(summary[key], body);
      const heading = stageNames[key] || describe(key).name;
      box.append(element('div', {}, element('h3', {}, heading), element('div', {class: 'scroll'}, element('table', {}, body))));
    }
    if (Object.keys(loose).length) {
      const body = element('tbody');
      rows(loose, body);
      box.append(element('div', {}, element('h3', {}, 'The run'), element('table', {}, body)));
    }
  }

  // The panels as cut against the same panels with other grain: what the cut is for.
  function comparison(sew) {
    if (!sew || !sew.compare || !Object.keys(sew.compare).length || typeof sew.mean_abs_shear !== 'number') return;
    const all = {aligned: sew, ...sew.compare};
    const top = Math.max(...Object.values(all).map(c => c.mean_abs_shear || 0)) || 1, body = element('tbody');
    for (const [name, c] of Object.entries(all)) {
      const cell = (v, factor) => element('td', {class: 'number'}, typeof v === 'number' ? show(v * factor, 3) : '–');
      body.append(element('tr', {}, element('td', {}, name === 'aligned' ? 'as cut, along the strain' : 'grain ' + name.replace(/_/g, ' ') + (/\d$/.test(name) ? '\u00b0' : ''),
          element('span', {class: 'meter', style: `width:${100 * (c.mean_abs_shear || 0) / top}%`})),
          cell(c.mean_abs_shear, 100), cell(c.max_abs_shear, 100), cell(c.shape_rms_m, 1e3)));
    }
    const head = ['The same pieces', 'mean shear, %', 'largest, %', 'off the cut surface, mm'];
    document.getElementById('comparison').append(element('h3', {}, 'What the grain does'), element('div', {class: 'scroll'}, element('table', {},
        element('thead', {}, element('tr', {}, ...head.map((h, i) => element('th', {class: i ? 'number' : ''}, h)))), body)));
  }

  function keyFigures(summary) {
    const box = document.getElementById('key-figures'), s = summary || {};
    const card = (number, unit, name, bad) => box.append(element('div', {class: bad ? 'key bad' : 'key'},
        element('div', {class: 'value'}, number, unit ? element('small', {}, ' ' + unit) : ''), element('div', {class: 'name'}, name)));
    const pick = (stage, key, name, factor = 1, unit = '', digits = 3) => {
      if (s[stage] && typeof s[stage][key] === 'number') card(show(s[stage][key] * factor, digits), unit, name);
    };
    for (const [stage, name] of [['inflate', 'inflated'], ['sew', 'sewn']])
      if (s[stage] && s[stage].converged === false) card('not converged', '', 'the ' + name + ' equilibrium; do not use its figures', true);
    const last = s.sew && typeof s.sew.volume_m3 === 'number' ? 'sew' : 'inflate';
    pick(last, 'volume_m3', 'liquid to mix', 1e3, 'l');
    pick(last, 'liquid_mass_kg', 'its mass', 1, 'kg');
    pick(last, 'depth_m', 'depth', 1e3, 'mm');
    pick('inflate', 'max_stretch', 'largest stretch', 1, '', 4);
    pick('segment', 'panels', 'panels');
    pick('panels', 'cloth_area_m2', 'cloth', 1, 'm\u00b2');
    pick('segment', 'seam_length_m', 'seams', 1, 'm');
    pick('sew', 'mean_abs_shear', 'mean shear, sewn', 100, '%');
    pick('sew', 'shape_rms_m', 'off the cut surface', 1e3, 'mm');
  }

  function convergencePlots(curves) {
    const box = document.getElementById('convergence-plots');
    const drawn = curves.map(c => ({...c, residual: c.residual.filter(r => r > 0)})).filter(c => c.residual.length > 1);
    if (!drawn.length) return;
    document.getElementById('convergence').hidden = false;
    const all = drawn.flatMap(c => c.residual), longest = Math.max(...drawn.map(c => c.residual.length));
    const top = Math.ceil(Math.log10(Math.max(...all))), bottom = Math.floor(Math.log10(Math.min(...all)));
    const w = 720, h = 320, left = 64, right = 130, head = 16, foot = 44;
    const x = i => left + (w - left - right) * i / (longest - 1), y = r => head + (h - head - foot) * (top - Math.log10(r)) / Math.max(1, top - bottom);
    const plot = svg('svg', {viewBox: `0 0 ${w} ${h}`, class: 'plot', role: 'img', 'aria-label': 'Residual after each iteration'});
    const every = Math.max(1, Math.ceil((top - bottom) / 8));
    for (let p = bottom; p <= top; p += every) {
      plot.append(svg('line', {class: 'axis', x1: left, x2: w - right, y1: y(10 ** p), y2: y(10 ** p)}));
      plot.append(svg('text', {x: left - 8, y: y(10 ** p) + 4, 'text-anchor': 'end'}, '1e' + String(p).replace('-', '\u2212')));
    }
    const step = Math.max(1, Math.ceil((longest - 1) / 8));
    for (let i = 0; i < longest; i += step) plot.append(svg('text', {x: x(i), y: h - foot + 18, 'text-anchor': 'middle'}, String(i)));
    plot.append(svg('text', {x: (left + w - right) / 2, y: h - 6, 'text-anchor': 'middle'}, 'iteration'));
    plot.append(svg('text', {x: 12, y: h / 2, 'text-anchor': 'middle', transform: `rotate(-90 12 ${h / 2})`}, 'residual / load'));
    const colours = ['#0a86a8', '#d06a00', '#2c9c69', '#a65aa0', '#7a8288'];
    drawn.forEach((c, k) => {
      const points = c.residual.map((r, i) => `${x(i).toFixed(1)},${y(r).toFixed(1)}`).join(' ');
      plot.append(svg('polyline', {points, fill: 'none', stroke: colours[k % 5], 'stroke-width': 2}));
      plot.append(svg('text', {x: x(c.residual.length - 1) + 8, y: Math.min(h - foot - 2, y(c.residual[c.residual.length - 1]) + 4), style: `fill:${colours[k % 5]}`}, c.name));
    });
    box.append(plot);
  }

  function pictures(list) {
    if (!list.length) return;
    document.getElementById('pictures').hidden = false;
    for (const p of list)
      document.getElementById('picture-list').append(element('figure', {},
          element('img', {src: 'data:image/png;base64,' + p.png, alt: p.title}),
          element('figcaption', {}, p.caption || p.title)));
  }

  function model(scene, notes) {
    const f = scene && scene.formwork ? scene.formwork : {}, inflate = f.inflate || {}, sew = f.sew || {};
    const material = m => !m ? '' : m.model === 'isotropic' ? 'an isotropic table in the frame of the principal strains' :
                           m.model === 'tensor' ? `the orthotropic tensor${m.data && typeof m.data === 'string' ? ' of ' + m.data.split('/').pop() : ''}` : String(m.model || '');
    const list = (heading, lines) => element('div', {}, element('h3', {}, heading), element('ul', {}, ...lines.filter(Boolean).map(l => element('li', {}, l))));
    const fabric = inflate.material || inflate.fabric;
    const compression = fabric && fabric.compression;
    document.getElementById('model-text').append(
      list('Modelled', [
        'The bag as a membrane in static equilibrium with the liquid: hydrostatic pressure \u03c1 g h below the level, zero above it.',
        fabric && `The inflated stage with ${material(fabric)}: what the bag wants to become before the weave is known.`,
        compression === 'tension_field' && 'Fabric that would be compressed wrinkles and carries tension along the wrinkles only (tension field).',
        compression === 'full' && 'Fabric that resists compression as it resists tension.',
        sew.material && `The sewn stage with ${material(sew.material)}, warp and weft as the panels are cut, and springs along the seams.`,
        inflate.self_weight !== false && 'The weight of the fabric itself.',
      ]),
      list('Not modelled', [
        'Bending of the fabric, so wrinkles are marked but their number and width are not predicted.',
        'Contact of the bag with itself, with the ground or with a frame other than the held nodes.',
        'Setting of the plaster: its heat, its expansion, the pressure lost while it stiffens, and filling in steps.',
        'Creep, wetting and tearing of the fabric; friction between warp and weft; the width of seam allowances.',
        'Leakage and the absorption of water by the cloth.',
      ]),
      notes.length ? list('Notes of this run', notes) : '');
  }

  function scene(text) {
    if (!text) return;
    document.getElementById('scene').hidden = false;
    document.getElementById('scene-text').textContent = typeof text === 'string' ? text : JSON.stringify(text, null, 2);
  }

  function theme() {
    const root = document.documentElement;
    document.getElementById('theme').addEventListener('click', () => {
      const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
      root.dataset.theme = dark ? 'light' : 'dark';
      document.dispatchEvent(new Event('themechange'));
    });
  }
  return {element, svg, show, keyFigures, comparison, figureTables, convergencePlots, pictures, model, scene, theme};
})();
