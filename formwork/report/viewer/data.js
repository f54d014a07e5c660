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

  function integers(a) {
    const b = bytes(a.data).buffer;
    return a.type === 'u16' ? new Uint16Array(b) : new Uint32Array(b);
  }

  // Colours of a map, 0..1 per part, at 256 even steps.
  const maps = {};
  for (const name of Object.keys(raw.maps)) maps[name] = Float32Array.from(bytes(raw.maps[name]), v => v / 255);

  const faces = integers(raw.mesh.faces);
  const shapes = raw.mesh.shapes.map(s => {
    const axes = s.x.map(numbers), x = new Float64Array(3 * axes[0].length);
    for (let k = 0; k < 3; ++k) axes[k].forEach((v, i) => { x[3 * i + k] = v; });
    return {key: s.key, name: s.name, x};
  });
  const panelOfFace = raw.mesh.panel ? integers(raw.mesh.panel) : null;
  const theta = raw.mesh.theta ? numbers(raw.mesh.theta) : null;
  const fields = raw.fields.map(f => ({...f, values: numbers(f.values)}));

  // Who is sewn to whom, and how long the seams are together, m.
  const neighbours = raw.panels.map(() => new Map());
  for (const s of raw.mesh.seams || []) {
    const [a, b] = s.panels;
    if (a < 0 || b < 0 || a === b || !neighbours[a] || !neighbours[b]) continue;
    neighbours[a].set(b, (neighbours[a].get(b) || 0) + s.length);
    neighbours[b].set(a, (neighbours[b].get(a) || 0) + s.length);
  }
  return {
    raw, faces, shapes, panelOfFace, theta, fields, maps, neighbours, panels: raw.panels,
    seams: raw.mesh.seams || [], singularities: raw.mesh.singularities || [], crossFaces: raw.mesh.cross_faces || [],
  };
})();
