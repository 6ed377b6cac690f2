// Bending spring, Iben et al. 2012, eq. 3, elastic part: pulls the edge towards its rest vector in its frame;
// the damping is part of the solve. Mirrored by reference/equations/bend_spring.h.
vec3 bendForce(float stiffness, vec3 edge, vec3 target) { return stiffness * (edge - target); }
