// Reads the report's data: arrays are base64 (report_data.cpp is their writer).
const Data = (() => {
  const raw = JSON.parse(document.getElementById('report-data').textContent);

  function bytes(base64) {
    const text = atob(base64), out = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
    return out;
  }

  // 16 bit steps between two ends; the last step means "no value".
  function numbers(a) {
    const steps = new Uint16Array(bytes(a.data).buffer), out = new Float64Array(steps.length);
    const unit = (a.high - a.low) / 65534;
    for (let i = 0; i < steps.length; ++i) out[i] = steps[i] === 65535 ? NaN : a.low + unit * steps[i];
    return out;
  }

  function plain(a) {
    const b = bytes(a.data).buffer;
    return a.type === 'u16' ? new Uint16Array(b) : a.type === 'f32' ? new Float32Array(b) : new Uint32Array(b);
  }

  // Colours of a map, 0..1 per part, at 256 even steps.
  const maps = {};
  for (const name of Object.keys(raw.maps)) maps[name] = Float32Array.from(bytes(raw.maps[name]), v => v / 255);

  const faces = plain(raw.mesh.faces);
  const shapes = raw.mesh.shapes.map(s => {
    const axes = s.x.map(numbers), x = new Float64Array(3 * axes[0].length);
    for (let k = 0; k < 3; ++k) axes[k].forEach((v, i) => { x[3 * i + k] = v; });
    return {key: s.key, name: s.name, x};
  });
  const panelOfFace = raw.mesh.panel ? plain(raw.mesh.panel) : null;
  const crosses = raw.mesh.crosses ? {faces: plain(raw.mesh.crosses.faces), parts: plain(raw.mesh.crosses.parts)} : null;
  const fields = raw.fields.map(f => ({...f, values: numbers(f.values)}));

  // Areas at rest: what shares and means of fields are weighted with.
  const areas = new Float64Array(faces.length / 3), rest = shapes[0].x;
  for (let f = 0; f < areas.length; ++f) {
    const [a, b, c] = [0, 1, 2].map(k => 3 * faces[3 * f + k]), u = [0, 1, 2].map(k => rest[b + k] - rest[a + k]), v = [0, 1, 2].map(k => rest[c + k] - rest[a + k]);
    areas[f] = Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }
  const ofFace = (field, f) => field.per_node ? (field.values[faces[3 * f]] + field.values[faces[3 * f + 1]] + field.values[faces[3 * f + 2]]) / 3 : field.values[f];

  // Per panel the seams around it: the panel beyond (-1: a rim), the seam and its length, m.
  const neighbours = raw.panels.map(() => []);
  (raw.mesh.seams || []).forEach((s, seam) => {
    const [a, b] = s.panels;
    if (neighbours[a]) neighbours[a].push({panel: b, seam, name: s.name, length: s.length});
    if (neighbours[b] && a !== b) neighbours[b].push({panel: a, seam, name: s.name, length: s.length});
  });
  for (const list of neighbours) list.sort((p, q) => p.panel - q.panel || p.seam - q.seam);
  return {
    raw, areas, ofFace, faces, shapes, panelOfFace, crosses, fields, maps, neighbours, panels: raw.panels,
    seams: raw.mesh.seams || [], singularities: raw.mesh.singularities || [],
    labelFaces: raw.mesh.label_faces || [],
  };
})();
