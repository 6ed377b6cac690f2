// Sorts particles of the volume by cell, 4 of 4: writes each particle's parcel to a place of its cell. The order within
// a cell is arbitrary; sums over a cell do not depend on it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  readBox();
  uint i;
  if (!findParticle(i)) return;
  uint place = startOf(cellNumber(cellOf(i))) + cellNumber(cellRank(i));
  vec3 inCells = placeInCells(placeOf(i));
  VolumeBrought bring = broughtBy(i);
  parcels[place].rate = bring.rate;
  setParcel(place, inCells, mat3(bring.gradientX.xyz, bring.gradientY.xyz, bring.gradientZ.xyz));
  cells[parcelMass(place)] = floatBitsToUint(numbers.unitsPerMass * volumeParticle(i).mass);
  located[i] = uvec4(floatBitsToUint(inCells), place);
}
