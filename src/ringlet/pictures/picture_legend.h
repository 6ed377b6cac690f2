// PictureLegend: a colour bar in the lower left corner of a picture, labelled with the values at its ends.
//
//     STRETCH
//     [blue .. green .. yellow .. red]
//     0                            5 %
#pragma once

#include <string>

#include "ringlet/output/picture.h"

namespace ringlet {

struct PictureLegend {
  std::string title, end;  // text above the bar; value of the last colour
};

/// Letters grow with the picture's height. Parts that do not fit the picture's width are left out.
void drawLegend(const PictureLegend& legend, Picture& picture);

}  // namespace ringlet
