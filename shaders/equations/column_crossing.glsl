// Where a column along x goes through a triangle: by integers, so that of all triangles around a point or beside
// an edge of a closed mesh a column through it counts each side of the surface once, whatever the order ("top-left
// rule" of rasterisers). The sum of crossings below a place is its winding number. Mirrored by
// reference/equations/column_crossing.h.
#ifndef RINGLET_COLUMN_CROSSING
#define RINGLET_COLUMN_CROSSING

/// turns: 1 where the column enters the surface's inside, -1 where it leaves, 0 where it passes by; x: there, in
/// the unit of x.
struct ColumnCrossing {
  int turns;
  float x;
};

/// Of the edge from a to b, seen from the column at q: twice the area that the three span, and whether a column on
/// the edge counts.
int areaBeside(ivec2 a, ivec2 b, ivec2 q) { return (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x); }
bool ownsItsEdge(ivec2 way) { return way.y < 0 || (way.y == 0 && way.x > 0); }
bool isWithin(int area, ivec2 way) { return area > 0 || (area == 0 && ownsItsEdge(way)); }

/// a, b, c: the triangle's corners across the column, rounded to steps; at most 2^14 apart along either axis, so
/// that products fit; q: the column; x: the corners' places along it.
ColumnCrossing columnCrossing(ivec2 a, ivec2 b, ivec2 c, vec3 x, ivec2 q) {
  int area = areaBeside(a, b, c);
  bool isTurned = area < 0;
  ivec2 second = isTurned ? c : b;
  ivec2 third = isTurned ? b : c;
  vec3 along = isTurned ? x.xzy : x;
  int ofFirst = areaBeside(second, third, q);
  int ofSecond = areaBeside(third, a, q);
  int ofThird = areaBeside(a, second, q);
  bool isThrough = area != 0 && isWithin(ofFirst, third - second) && isWithin(ofSecond, a - third) &&
                   isWithin(ofThird, second - a);
  float at = dot(vec3(ofFirst, ofSecond, ofThird), along) / float(max(abs(area), 1));
  return ColumnCrossing(isThrough ? (isTurned ? 1 : -1) : 0, at);
}

#endif
