// Every key of scene files that is a path, in a scene of its own: for tests of what a scene may name.
#pragma once

#include <string>
#include <vector>

namespace ringlet::test {

/// A scene with one path, PATH, a key of the program's own table each; `key` as messages have it.
struct PathCase {
  std::string key, scene;
};
inline std::vector<PathCase> pathCases() {
  const std::string groom = "[groom]\nfile = 'groom.obj'\n";
  return {
      {"groom.file", "[groom]\nfile = 'PATH'\n"},
      {"groom.guides_file", groom + "guides_file = 'PATH'\n"},
      {"start.from", groom + "[start]\nfrom = 'PATH'\n"},
      {"groom.scalp", "[groom]\ngenerate = 'head'\nscalp = 'PATH'\n"},
      {"motion.file", groom + "[motion]\nfile = 'PATH'\n"},
      {"scalp.file", groom + "[scalp]\nfile = 'PATH'\n"},
      {"goal.file", groom + "[goal]\nfile = 'PATH'\n"},
      {"body.file", groom + "[[body]]\nname = 'b'\nshape = 'mesh'\nfile = 'PATH'\n"},
      {"body.cache",
       groom + "[[body]]\nname = 'b'\nshape = 'mesh'\nfile = 'a.obj'\ndeforms = true\ncache = 'PATH'\n"},
      {"body.moves.file", groom + "[[body]]\nname = 'b'\nshape = 'sphere'\n[body.moves]\nfile = 'PATH'\n"},
      {"scalp.cache", groom + "[scalp]\nfile = 'a.obj'\ncache = 'PATH'\n"},
      {"camera.file", groom + "[[camera]]\nname = 'c'\nfile = 'PATH'\n"},
      {"field.file", groom + "[[field]]\nname = 'f'\nkind = 'grid'\nstrength = 1\nfile = 'PATH'\n"},
      {"map.file", groom + "[[map]]\nnumber = 'bend_stiffness'\nfile = 'PATH'\n"},
      {"map.texture", groom + "[[map]]\nnumber = 'bend_stiffness'\ntexture = 'PATH'\n"},
      {"output.hair_scalp_file", groom + "[output]\nhairs = 9\nhair_scalp_file = 'PATH'\n"},
      {"output.folder", groom + "[output]\nfolder = 'PATH'\n"},
      {"material.file", groom + "[material]\nfile = 'PATH'\n"}};
}

inline std::string withPath(const PathCase& c, const std::string& path) {
  std::string text = c.scene;
  return text.replace(text.find("PATH"), 4, path);
}

}  // namespace ringlet::test
