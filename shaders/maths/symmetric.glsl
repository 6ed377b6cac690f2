// Symmetric 3x3 matrices in six numbers.
#ifndef RINGLET_SYMMETRIC
#define RINGLET_SYMMETRIC

struct Symmetric {
  vec3 d;  // xx, yy, zz
  vec3 o;  // yz, xz, xy
};

Symmetric symmetricDiagonal(float s) { return Symmetric(vec3(s), vec3(0)); }
Symmetric add(Symmetric a, Symmetric b) { return Symmetric(a.d + b.d, a.o + b.o); }
Symmetric scale(Symmetric a, float s) { return Symmetric(a.d * s, a.o * s); }
Symmetric addDiagonal(Symmetric a, float s) { return Symmetric(a.d + s, a.o); }

/// a + s x xᵀ
Symmetric addOuter(Symmetric a, float s, vec3 x) {
  vec3 sx = s * x;
  return Symmetric(a.d + sx * x, a.o + sx.yxx * x.zzy);
}

vec3 multiply(Symmetric a, vec3 x) {
  return vec3(a.d.x * x.x + a.o.z * x.y + a.o.y * x.z,
              a.o.z * x.x + a.d.y * x.y + a.o.x * x.z,
              a.o.y * x.x + a.o.x * x.y + a.d.z * x.z);
}

mat3 toMatrix(Symmetric a) {
  return mat3(a.d.x, a.o.z, a.o.y, a.o.z, a.d.y, a.o.x, a.o.y, a.o.x, a.d.z);
}
mat3 multiply(Symmetric a, mat3 b) { return mat3(multiply(a, b[0]), multiply(a, b[1]), multiply(a, b[2])); }

/// The six numbers of a product known to be symmetric, a b with a and b commuting.
Symmetric multiplyCommuting(Symmetric a, Symmetric b) {
  return Symmetric(a.d * b.d + vec3(a.o.z * b.o.z + a.o.y * b.o.y, a.o.z * b.o.z + a.o.x * b.o.x,
      a.o.y * b.o.y + a.o.x * b.o.x),
                   vec3(a.o.z * b.o.y + a.d.y * b.o.x + a.o.x * b.d.z,
                        a.d.x * b.o.y + a.o.z * b.o.x + a.o.y * b.d.z,
                        a.d.x * b.o.z + a.o.z * b.d.y + a.o.y * b.o.x));
}

/// x s for a product known to be symmetric.
Symmetric symmetricProduct(mat3 x, Symmetric s) {
  vec3 rowX = vec3(x[0].x, x[1].x, x[2].x);
  vec3 rowY = vec3(x[0].y, x[1].y, x[2].y);
  vec3 rowZ = vec3(x[0].z, x[1].z, x[2].z);
  vec3 s0 = vec3(s.d.x, s.o.z, s.o.y);
  vec3 s1 = vec3(s.o.z, s.d.y, s.o.x);
  vec3 s2 = vec3(s.o.y, s.o.x, s.d.z);
  return Symmetric(vec3(dot(rowX, s0), dot(rowY, s1), dot(rowZ, s2)),
                   vec3(dot(rowY, s2), dot(rowX, s2), dot(rowX, s1)));
}

/// xᵀ y for a product known to be symmetric (y = S x with S symmetric).
Symmetric transposeMultiply(mat3 x, mat3 y) {
  return Symmetric(vec3(dot(x[0], y[0]), dot(x[1], y[1]), dot(x[2], y[2])),
                   vec3(dot(x[1], y[2]), dot(x[0], y[2]), dot(x[0], y[1])));
}

/// Inverse of a positive definite matrix, by cofactors.
Symmetric inverse(Symmetric a) {
  vec3 c = a.d.yxx * a.d.zzy - a.o * a.o;              // cofactors xx, yy, zz
  vec3 o = a.o.yxx * a.o.zzy - a.d * a.o;              // yz, xz, xy
  float s = 1.0 / (a.d.x * c.x + a.o.z * o.z + a.o.y * o.y);
  return Symmetric(c * s, o * s);
}

#endif
