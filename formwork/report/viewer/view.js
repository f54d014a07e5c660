// The 3-D view: one triangulation, several shapes, any field as colour, lines and marks on top. Draws on demand.
const View = (() => {
  const toLinear = c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  const linear = rgb => rgb.map(toLinear);
  const parse = css => [1, 3, 5].map(i => parseInt(css.slice(i, i + 2), 16) / 255);
  const classColours = [[0.72, 0.78, 0.84], [0.90, 0.62, 0.20], [0.80, 0.35, 0.12]];   // taut, wrinkled, slack

  function colourOfMap(name, t) {
    const table = Data.maps[name], s = Math.min(1, Math.max(0, t)) * 255, i = Math.min(254, Math.floor(s)), f = s - i;
    return [0, 1, 2].map(k => table[3 * i + k] * (1 - f) + table[3 * i + 3 + k] * f);
  }

  function create(box, listener) {
    const renderer = new THREE.WebGLRenderer({antialias: true, alpha: true, preserveDrawingBuffer: true});
    renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    const canvas = renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', 'The bag in three dimensions. Arrow keys turn it, plus and minus zoom, R resets.');
    box.append(canvas);

    const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(28, 1, 0.01, 100);
    const up = new THREE.Vector3(...Data.raw.up).normalize();
    camera.up.copy(up);
    const controls = new THREE.OrbitControls(camera, canvas);
    controls.enableDamping = false;
    const lamp = new THREE.DirectionalLight(0xffffff, 1.5);
    scene.add(camera, new THREE.AmbientLight(0xffffff, 2.0));
    camera.add(lamp);
    lamp.position.set(-0.6, 0.9, 1.2);

    const nFaces = Data.faces.length / 3, nNodes = Data.shapes[0].x.length / 3;
    const geometry = new THREE.BufferGeometry();
    const positions = new THREE.BufferAttribute(new Float32Array(9 * nFaces), 3);
    const normals = new THREE.BufferAttribute(new Float32Array(9 * nFaces), 3);
    const colours = new THREE.BufferAttribute(new Float32Array(9 * nFaces), 3);
    geometry.setAttribute('position', positions);
    geometry.setAttribute('normal', normals);
    geometry.setAttribute('color', colours);
    const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({
      vertexColors: true, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2}));
    mesh.frustumCulled = false;
    scene.add(mesh);

    // The middle and half diagonal of all shapes together, so that nothing jumps when the shape changes.
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const s of Data.shapes)
      for (let i = 0; i < s.x.length; ++i) { low[i % 3] = Math.min(low[i % 3], s.x[i]); high[i % 3] = Math.max(high[i % 3], s.x[i]); }
    const middle = new THREE.Vector3(...low.map((v, k) => (v + high[k]) / 2));
    const radius = Math.hypot(...low.map((v, k) => high[k] - v)) / 2 || 1;

    const state = {shape: null, x: Float64Array.from(Data.shapes[0].x), normal: new Float64Array(3 * nNodes), field: 'panel',
                   chosen: new Set(), seams: true, cross: false, seam: -1, labels: {mark: true, tag: false}};
    const lines = {};

    function lineSet(colour, width) {
      const material = new THREE.LineMaterial({color: colour, linewidth: width});
      const object = new THREE.LineSegments2(new THREE.LineSegmentsGeometry(), material);
      object.frustumCulled = false;
      scene.add(object);
      return object;
    }
    const seamPairs = [], rimPairs = [];
    for (const s of Data.seams)
      for (let i = 0; i + 1 < s.nodes.length; ++i) (s.panels[1] < 0 ? rimPairs : seamPairs).push([s.nodes[i], s.nodes[i + 1]]);
    if (seamPairs.length) lines.seams = lineSet(0x0c0e11, 3);
    if (rimPairs.length) lines.rims = lineSet(0x6b7278, 2);
    if (Data.seams.length) { lines.seam = lineSet(0xff5a1f, 7); lines.seam.visible = false; }

    if (Data.crosses) lines.cross = lineSet(0x14202c, 1.6);

    function label(name, text, title, colour, at) {   // at: nodes whose mean it marks
      const node = document.createElement('span');
      node.className = name;
      node.textContent = text;
      node.title = title;
      if (colour) node.style.background = colour;
      box.append(node);
      return {node, at, kind: name, hidden: false};
    }
    const marks = Data.singularities.map(s => {
      const valence = 4 - s.index4, title = `singularity of valence ${valence}, index ${s.index4 > 0 ? '+' : '\u2212'}${Math.abs(s.index4)}/4`;
      return label('mark', valence, title, s.index4 > 0 ? '#c24a05' : '#0d5cab', [s.node]);
    });
    // A panel's name may stand at any of these places of it: about forty faces, with the room around each.
    Data.labelFaces.forEach((widest, p) => {
      if (widest < 0 || !Data.panels[p]) return;
      const own = [], x = Data.shapes[0].x, border = Data.neighbours[p].flatMap(n => Data.seams[n.seam].nodes);
      Data.panelOfFace.forEach((q, f) => { if (q === p) own.push(f); });
      const places = own.filter((f, i) => f === widest || i % Math.ceil(own.length / 40) === 0).map(f => {
        const i = 3 * Data.faces[3 * f];
        return {node: Data.faces[3 * f], room: Math.min(...border.map(b => Math.hypot(x[3 * b] - x[i], x[3 * b + 1] - x[i + 1], x[3 * b + 2] - x[i + 2])))};
      });
      marks.push({...label('tag', Data.panels[p].name, '', null, [places[0].node]), places});
    });
    // Moves a name to the place of its panel that the viewer sees best.
    function seekPlace(m) {
      let best = 0;
      for (const {node, room} of m.places) {
        const i = 3 * node, at = [0, 1, 2].map(k => state.x[i + k]), eye = camera.position.toArray().map((v, k) => v - at[k]);
        const rank = room * eye.reduce((s, v, k) => s + v * state.normal[i + k], 0) / Math.hypot(...eye);
        if (rank > best) { best = rank; m.at = [node]; }
      }
    }
    const place = m => new THREE.Vector3(...[0, 1, 2].map(k => m.at.reduce((s, i) => s + state.x[3 * i + k] / m.at.length, 0)));

    function updateShape() {
      const {x, normal} = state, p = positions.array, q = normals.array, faces = Data.faces;
      normal.fill(0);
      for (let f = 0; f < nFaces; ++f) {
        const a = 3 * faces[3 * f], b = 3 * faces[3 * f + 1], c = 3 * faces[3 * f + 2];
        const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2];
        const vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
        const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        for (const i of [a, b, c]) { normal[i] += nx; normal[i + 1] += ny; normal[i + 2] += nz; }
      }
      for (let i = 0; i < normal.length; i += 3) {
        const l = Math.hypot(normal[i], normal[i + 1], normal[i + 2]) || 1;
        normal[i] /= l; normal[i + 1] /= l; normal[i + 2] /= l;
      }
      for (let i = 0; i < 3 * nFaces; ++i)
        for (let k = 0; k < 3; ++k) { p[3 * i + k] = x[3 * faces[i] + k]; q[3 * i + k] = normal[3 * faces[i] + k]; }
      positions.needsUpdate = normals.needsUpdate = true;
      geometry.boundingSphere = geometry.boundingBox = null;

      const lift = 0.0015 * radius;
      const raised = i => [0, 1, 2].map(k => x[3 * i + k] + lift * normal[3 * i + k]);
      for (const [name, pairs] of [['seams', seamPairs], ['rims', rimPairs]])
        if (lines[name]) lines[name].geometry.setPositions(pairs.flatMap(([a, b]) => [...raised(a), ...raised(b)]));
      updateSeam();
      if (lines.cross) {
        const out = [];
        Data.crosses.faces.forEach((f, i) => {
          const [a, b, c] = [0, 1, 2].map(k => 3 * faces[3 * f + k]), parts = Data.crosses.parts;
          for (let arm = 4 * i; arm < 4 * i + 4; arm += 2)
            for (const sign of [-1, 1])
              for (let k = 0; k < 3; ++k) {
                const centre = (x[a + k] + x[b + k] + x[c + k]) / 3 + 2 * lift * normal[a + k];
                out.push(centre + sign * (parts[arm] * (x[b + k] - x[a + k]) + parts[arm + 1] * (x[c + k] - x[a + k])));
              }
        });
        lines.cross.geometry.setPositions(out);
      }
    }

    function updateSeam() {
      const s = Data.seams[state.seam];
      if (!lines.seam) return;
      lines.seam.visible = Boolean(s);
      if (!s) return;
      const {x, normal} = state, raised = i => [0, 1, 2].map(k => x[3 * i + k] + 0.003 * radius * normal[3 * i + k]);
      lines.seam.geometry.setPositions(s.nodes.slice(1).flatMap((b, i) => [...raised(s.nodes[i]), ...raised(b)]));
    }

    function faceColour(f, field) {
      if (field === 'panel') return Data.panelOfFace && Data.panels[Data.panelOfFace[f]] ? Data.panels[Data.panelOfFace[f]].rgb : [0.8, 0.81, 0.82];
      const v = field.values[f];
      if (field.classes.length) return classColours[Math.round(v)] || [0.6, 0.6, 0.6];
      return Number.isNaN(v) ? [0.6, 0.6, 0.6] : colourOfMap(field.map, (v - field.low) / (field.high - field.low));
    }
    for (const p of Data.panels) p.rgb = parse(p.colour);

    function updateColours() {
      const field = Data.fields.find(f => f.key === state.field) || 'panel', c = colours.array;
      const nodeColours = field.per_node ? Array.from(field.values, v => colourOfMap(field.map, (v - field.low) / (field.high - field.low))) : null;
      for (let f = 0; f < nFaces; ++f) {
        const faint = state.chosen.size && Data.panelOfFace && !state.chosen.has(Data.panelOfFace[f]);
        const whole = nodeColours ? null : faceColour(f, field);
        for (let k = 0; k < 3; ++k) {
          let rgb = whole || nodeColours[Data.faces[3 * f + k]];
          if (faint) { const g = 0.3 * rgb[0] + 0.5 * rgb[1] + 0.2 * rgb[2]; rgb = rgb.map(v => 0.25 * v + 0.25 * g + 0.42); }
          const l = linear(rgb);
          for (let m = 0; m < 3; ++m) c[9 * f + 3 * k + m] = l[m];
        }
      }
      colours.needsUpdate = true;
    }

    const ray = new THREE.Raycaster();
    function pick(x, y) {   // px in the box
      ray.setFromCamera(new THREE.Vector2(2 * x / box.clientWidth - 1, 1 - 2 * y / box.clientHeight), camera);
      const hit = ray.intersectObject(mesh, false)[0];
      return hit ? {face: hit.faceIndex, distance: hit.distance, point: hit.point} : null;
    }

    function placeMarks() {
      for (const m of marks) {
        if (m.places && state.labels.tag) seekPlace(m);
        const v = place(m).project(camera);
        m.node.style.left = (v.x + 1) / 2 * box.clientWidth + 'px';
        m.node.style.top = (1 - v.y) / 2 * box.clientHeight + 'px';
        m.node.hidden = !state.labels[m.kind] || m.hidden || Math.abs(v.x) > 1 || Math.abs(v.y) > 1;
      }
    }
    // Which marks lie behind the bag: asked of the triangles when the view has come to rest.
    function hideMarks() {
      for (const m of marks) {
        const at = place(m), v = at.clone().project(camera);
        const hit = pick((v.x + 1) / 2 * box.clientWidth, (1 - v.y) / 2 * box.clientHeight);
        m.hidden = Boolean(hit) && hit.distance < camera.position.distanceTo(at) - 0.02 * radius;
      }
      placeMarks();
    }

    let wanted = false, settle = 0;
    function draw() {
      if (wanted) return;
      wanted = true;
      requestAnimationFrame(() => {
        wanted = false;
        renderer.render(scene, camera);
        placeMarks();
        clearTimeout(settle);
        if (marks.length) settle = setTimeout(hideMarks, 120);
      });
    }
    controls.addEventListener('change', draw);

    function resize() {
      const w = box.clientWidth, h = box.clientHeight;
      if (!w || !h) return;
      renderer.setSize(w, h);
      camera.aspect = w / h;
      camera.updateProjectionMatrix();
      draw();
    }
    function reset() {
      const east = new THREE.Vector3(1, 0, 0);
      if (Math.abs(up.x) > 0.9) east.set(0, 1, 0);
      east.addScaledVector(up, -up.dot(east)).normalize();
      const north = up.clone().cross(east), a = -55 * Math.PI / 180, h = 16 * Math.PI / 180;
      const back = east.multiplyScalar(Math.cos(a)).addScaledVector(north, Math.sin(a)).multiplyScalar(Math.cos(h)).addScaledVector(up, Math.sin(h));
      const half = Math.tan(camera.fov * Math.PI / 360) * Math.min(1, camera.aspect);
      const distance = 1.02 * radius / half;
      camera.near = 0.02 * radius;
      camera.far = 20 * radius;
      controls.target.copy(middle);
      camera.position.copy(middle).addScaledVector(back, distance);
      controls.minDistance = 0.2 * radius;
      controls.maxDistance = 8 * radius;
      camera.updateProjectionMatrix();
      controls.update();
      draw();
    }
    function turn(sideways, upwards) {
      const offset = camera.position.clone().sub(controls.target).applyAxisAngle(up, sideways);
      const right = up.clone().cross(offset).normalize();
      const steep = offset.angleTo(up) - upwards;
      if (steep > 0.05 && steep < Math.PI - 0.05) offset.applyAxisAngle(right, -upwards);
      camera.position.copy(controls.target).add(offset);
      controls.update();
      draw();
    }
    function zoom(factor) {
      camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target);
      controls.update();
      draw();
    }

    let motion = 0;
    function setShape(key, at_once) {
      const goal = Data.shapes.find(s => s.key === key);
      if (!goal || state.shape === key) return;
      state.shape = key;
      const from = Float64Array.from(state.x), still = at_once || matchMedia('(prefers-reduced-motion: reduce)').matches;
      const begin = performance.now(), id = ++motion, ms = 450;
      const step = now => {
        if (id !== motion) return;
        const t = still ? 1 : Math.min(1, Math.max(0, (now - begin) / ms)), s = t * t * (3 - 2 * t);
        for (let i = 0; i < from.length; ++i) state.x[i] = from[i] + s * (goal.x[i] - from[i]);
        updateShape();
        draw();
        if (t < 1) requestAnimationFrame(step);
      };
      step(begin);
    }
    function setField(key) { state.field = key; updateColours(); draw(); }
    function setChosen(panels) { state.chosen = new Set(panels); updateColours(); draw(); }
    function setSeam(seam) { state.seam = seam; updateSeam(); draw(); }
    function setVisible(name, on) {
      if (name === 'seams') for (const k of ['seams', 'rims']) { if (lines[k]) lines[k].visible = on; }
      else if (name in state.labels) state.labels[name] = on;
      else if (lines[name]) lines[name].visible = on;
      draw();
    }

    // A click is a press that did not drag.
    let press = null;
    canvas.addEventListener('pointerdown', e => { press = [e.clientX, e.clientY]; });
    canvas.addEventListener('pointerup', e => {
      if (!press || Math.hypot(e.clientX - press[0], e.clientY - press[1]) > 5) return;
      const r = box.getBoundingClientRect(), hit = pick(e.clientX - r.left, e.clientY - r.top);
      listener.click(hit && Data.panelOfFace ? Data.panelOfFace[hit.face] : -1);
    });
    let hovering = false;
    canvas.addEventListener('pointermove', e => {
      if (hovering || e.buttons) return;
      hovering = true;
      requestAnimationFrame(() => {
        hovering = false;
        const r = box.getBoundingClientRect();
        listener.hover(pick(e.clientX - r.left, e.clientY - r.top));
      });
    });
    canvas.addEventListener('pointerleave', () => listener.hover(null));
    canvas.addEventListener('keydown', e => {
      const keys = {ArrowLeft: () => turn(-0.15, 0), ArrowRight: () => turn(0.15, 0), ArrowUp: () => turn(0, 0.12), ArrowDown: () => turn(0, -0.12),
                    '+': () => zoom(0.87), '=': () => zoom(0.87), '-': () => zoom(1.15), r: reset, R: reset};
      const act = keys[e.key] || (/^[1-9]$/.test(e.key) && (() => listener.key(Number(e.key) - 1)));
      if (act) { e.preventDefault(); act(); }
    });

    new ResizeObserver(resize).observe(box);
    resize();
    reset();
    updateColours();
    return {setShape, setField, setChosen, setSeam, setVisible, state, hasCross: Boolean(lines.cross),
            picture: () => { renderer.render(scene, camera); return canvas.toDataURL('image/png'); }};
  }
  return {create, colourOfMap, classColours};
})();
