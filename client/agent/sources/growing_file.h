// A text file that another program appends to, line by line.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace truepose::agent {

struct TextLine {
  int64_t number = 0;  // counted from 1 in its file
  std::string text;    // without its end
  bool cut = false;    // it was longer than a line may be; the text is its beginning
};

// Reads what is there and remembers where it was. Memory is bounded by a line and a block, whatever
// the file does.
class GrowingFile {
 public:
  enum class State {
    kLines,     // there are lines, and there may be more: ask again at once
    kEnd,       // all that is there was read; the last line, while it has no end, is not handed out
    kMissing,   // no such file, or it can't be opened
    kReplaced,  // the path is another file now; the old one was read to its end, its last line too
    kRewritten  // the file is shorter, or what was read is no longer what stands there
  };

  GrowingFile(std::string path, size_t longest_line);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  // Adds the next lines of at most a block. After kReplaced and kRewritten, `lines` belong to the
  // old file, and the next call begins at the new one's first line.
  State Read(std::vector<TextLine>* lines);

  // The last line although it has no end; for a file that is known to be whole. Adds nothing when
  // there is none.
  void TakeRest(std::vector<TextLine>* lines);

  const std::string& path() const { return path_; }

 private:
  bool Open();
  void Close();
  bool IsRewritten() const;
  bool IsReplaced() const;
  State AtEnd(std::vector<TextLine>* lines);
  void Split(const char* block, size_t size, std::vector<TextLine>* lines);
  void AppendToRest(const char* begin, size_t size);
  void EndLine(std::vector<TextLine>* lines);
  void Remember(const char* block, size_t size);

  const std::string path_;
  const size_t longest_line_;
  int descriptor_ = -1;
  off_t offset_ = 0;
  std::string rest_;  // the line that has no end yet
  bool rest_is_cut_ = false;
  std::string tail_;  // the last bytes before offset_, to notice that they changed
  int64_t lines_ = 0;
};

}  // namespace truepose::agent
