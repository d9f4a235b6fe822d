// Contours of a grid of heights: closed regions above a level, and the lines along them.
//
// Marching squares, after W. E. Lorensen and H. E. Cline, ACM SIGGRAPH 21 (1987) 163, in the plane. Points are places
// on the grid, [column, row] with fractions. Where there is no height, and outside the grid, nothing is above a level.

// Corners of a cell, all the way round.
const ROUND = [[0, 0], [1, 0], [1, 1], [0, 1]];

// The regions above a level, each a closed list of points; `edge` is how far they reach towards a missing height.
export function regions(rows, level, edge = 0) {
  const [height, width] = [rows.length, rows[0].length];
  const at = ([c, r]) => rows[r]?.[c] ?? NaN;
  const isAbove = (corner) => at(corner) >= level;
  const next = new Map(); // from crossing to crossing, the region always on the same side
  const points = new Map();
  const edges = new Set(); // the crossings from which the way goes along the grid's edge or a missing height

  // The crossing between two corners, by a key that both cells beside it have in common.
  function crossing(inner, outer) {
    const [c, r] = [Math.min(inner[0], outer[0]), Math.min(inner[1], outer[1])];
    const key = 2 * ((r + 1) * (width + 2) + c + 1) + (inner[0] === outer[0] ? 1 : 0);
    const isOutside = outer[0] < 0 || outer[1] < 0 || outer[0] >= width || outer[1] >= height;
    const isMissing = !Number.isFinite(at(outer));
    const share = isOutside ? 0 : isMissing ? edge : (at(inner) - level) / (at(inner) - at(outer));
    points.set(key, inner.map((one, i) => one + share * (outer[i] - one)));
    return key;
  }

  for (let r = -1; r < height; r += 1) {
    for (let c = -1; c < width; c += 1) {
      const corners = ROUND.map(([right, down]) => [c + right, r + down]);
      const above = corners.map(isAbove);
      if (above[0] === above[1] && above[1] === above[2] && above[2] === above[3]) continue;
      // From where the way round leaves the region to where it comes back.
      for (let leaves = 0; leaves < 4; leaves += 1) {
        if (!above[leaves] || above[(leaves + 1) % 4]) continue;
        let back = (leaves + 1) % 4;
        while (!above[(back + 1) % 4]) back = (back + 1) % 4;
        const from = crossing(corners[leaves], corners[(leaves + 1) % 4]);
        next.set(from, crossing(corners[(back + 1) % 4], corners[back]));
        if (!corners.map(at).every(Number.isFinite)) edges.add(from);
      }
    }
  }
  return chained(next).map((loop) => loop.map((key) => ({ point: points.get(key), isEdge: edges.has(key) })));
}

function chained(next) {
  const loops = [];
  while (next.size > 0) {
    const loop = [];
    for (let [key] = next.keys(); next.has(key);) {
      loop.push(key);
      const after = next.get(key);
      next.delete(key);
      key = after;
    }
    loops.push(loop);
  }
  return loops;
}

// The outlines of regions without the parts along the grid's edge and missing heights.
export function outlines(loops) {
  return loops.flatMap((loop) => {
    const from = loop.findIndex(({ isEdge }) => isEdge) + 1; // else anywhere
    const pieces = [[]];
    for (const here of [...loop.slice(from), ...loop.slice(0, from)]) {
      pieces.at(-1).push(here);
      if (here.isEdge) pieces.push([]);
    }
    if (from === 0) pieces[0].push(loop[0]);
    return pieces.filter((piece) => piece.length > 1);
  });
}
