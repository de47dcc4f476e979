#include "app/labs/kit/verdict.hpp"

#include "app/widgets/fields.hpp"

namespace tendril::app {

void show_verdict(const Verdict& said, const Palette& palette) {
    verdict(said.text, said.kind == Verdict::Kind::Bad ? palette.limit : palette.text);
    if (!said.why.empty()) note(said.why);
}

}  // namespace tendril::app
