// Implements solver/contacts/hair_contacts.h.
#include "ringlet/solver/contacts/hair_contacts.h"

namespace ringlet {

Status HairContacts::forget() {
  if (pairs) {
    if (Status status = pairs->forget(); !status) return status;
  }
  return volume ? volume->forget() : Status{};
}

Status HairContacts::archive(Archive& archive) {
  if (volume) {
    if (Status status = volume->archive(archive); !status) return status;
  }
  if (crossings) crossings->archive(archive);
  return pairs ? pairs->archive(archive) : Status{};
}

Result<ContactReport> HairContacts::report() const {
  ContactReport report = atRest;
  if (pairs) {
    report.listedSides = pairs->listedSides();
    const auto sides = pairs->contactSides();
    if (!sides) return sides.error();
    report.contactSides = *sides;
    report.rebuilds = pairs->rebuilds();
    report.pairTests = pairs->pairTests();
  }
  if (volume) {
    const auto reached = volume->reached();
    if (!reached) return reached.error();
    report.volumeCut = reached->cut, report.volumeLargest = reached->largest;
    report.volumeCoarsest = reached->coarsest;
  }
  if (crossings) report.ways = crossings->report();
  return report;
}

}  // namespace ringlet
