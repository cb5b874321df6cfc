// Names out of files, on their way to become names of files.
#pragma once

#include <string>
#include <string_view>

namespace skel {

// A name for a file made of any text, such as a clip's: of one folder, not hidden, on one line, at most 120
// bytes. What is not allowed becomes '_'; a name that is fine stays as it is.
std::string safeFileName(std::string_view text);

// Whether the file `path` lies in the folder `dir` or below it, whatever links to folders lead there. A file
// that is a link itself lies where the link does: it is read, and what belongs to it is written beside it.
bool liesBelow(const std::string& dir, const std::string& path);

// The file that `named` in a file of the folder `dir` means. Throws InputError(`file`) if it lies outside of
// `dir`: an absolute path, or one that leads out by `..` or by a link to another folder.
std::string pathInside(const std::string& dir, const std::string& named, const std::string& file);

// A to Z as a to z, whatever the locale.
std::string inSmallLetters(std::string text);
// ".png" of Hero.PNG, with its dot; "": it has none.
std::string endingOf(const std::string& path);

// `start`, from the second on a number, `end`: boy.old.png, boy.old-2.png.
std::string numberedName(const std::string& start, const std::string& end, int number);
// The first of these paths at which nothing lies.
std::string freeNumberedName(const std::string& start, const std::string& end);

// A path as one word of a shell's line: in quotes where it needs them; what is not printed as bash writes it
// ($'\x1b').
std::string shellWord(const std::string& path);

}  // namespace skel
