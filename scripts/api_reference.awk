# For doxygen: makes documentation of the comments that headers have. The first lines of a file are about the file, a comment
# above a member or behind it is about that, and one of C's with a blank line below it is a heading. Texts are taken as they are:
# no word of theirs is a command of doxygen's.
function plain(text) {
  gsub(/[@\\]/, "\\\\&", text)
  gsub(/</, "\\&lt;", text)
  gsub(/#/, "\\\\#", text)
  return text
}
# C's comments, which are held until it is known what follows.
function release(isHeading) {
  if (held != "") print (isHeading ? "/*" : "/**") held
  held = ""
}
FNR == 1 { isC = /^\/\*/; isHead = 1 }
isC && inHeld { held = held "\n" plain($0); if (/\*\//) inHeld = 0; next }
isC && inMember { print plain($0); if (/\*\//) inMember = 0; next }
isC && /^ *\/\*/ {
  release(0)
  held = (isHead ? " @file\n" : "") plain(substr($0, index($0, "/*") + 2))
  if (isHead) { isHead = 0; print "/**" held; held = ""; inMember = !/\*\//; next }
  inHeld = !/\*\//
  next
}
isC { release(/^ *$/) }
isC && /[;,] *\/\*/ {
  at = index($0, "/*")
  print substr($0, 1, at - 1) "/**<" plain(substr($0, at + 2))
  inMember = !/\*\//
  next
}
isC { print; next }

# C++
isHead && /^\/\// { print (FNR == 1 ? "/// @file\n" : "") "///" plain(substr($0, 3)); next }
{ isHead = 0 }
/^ *\/\/\// { at = index($0, "///"); print substr($0, 1, at + 2) plain(substr($0, at + 3)); column = 0; next }
/[;,}] +\/\/ / { at = index($0, " // "); print substr($0, 1, at) "///<" plain(substr($0, at + 3)); column = at + 1; next }
# What is behind a member goes on below it in the same column; else it is above the next one.
/^ +\/\/ / { at = index($0, "//"); print substr($0, 1, at - 1) (column == at ? "///<" : "///") plain(substr($0, at + 2)); next }
{ column = 0; print }
