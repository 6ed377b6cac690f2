// PictureLegend: a bar of colours in the lower left corner of pictures, with what its ends stand for.
//
//     STRETCH
//     [blue .. green .. yellow .. red]
//     0                            5 %
#pragma once

#include <string>

#include "ringlet/output/picture.h"

namespace ringlet {

struct PictureLegend {
  std::string title, end;  // above the bar; what the last colour stands for
};

/// In letters that grow with the picture's height. In one too narrow for its words parts are left out.
void drawLegend(const PictureLegend& legend, Picture& picture);

}  // namespace ringlet
