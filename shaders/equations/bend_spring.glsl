// Bending spring, Iben et al. 2012, eq. 3, elastic part: pulls the edge to where its frame says it was at rest; its
// damping is in the solve. Mirrored by reference/equations/bend_spring.h.
vec3 bendForce(float stiffness, vec3 edge, vec3 target) { return stiffness * (edge - target); }
