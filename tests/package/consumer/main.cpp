#include <cstdio>
#include <stdexcept>
#include <tendril/chain/chain.hpp>
#include <tendril/version.hpp>

int main() {
    tendril::Chain chain(glm::vec3(0, 0, -1));
    for (int i = 0; i < 3; ++i) chain.add(1.0f);
    try {
        chain.set_length(7, 1.0f);
        return 1;
    } catch (const std::out_of_range&) {  // exceptions of the library reach the program that uses it
    }
    chain.forward({1, 2, 3});
    chain.backward({1, 2, 1});
    chain.fixed({1, 2, 3}, {.iterations = 8});
    const glm::vec3 head = chain.position(0), tail = chain.position(2);
    std::printf("tendril %s: %zu segments, reach %g, head at %.0f %.0f %.0f, tail at %.0f %.0f %.0f\n",
                tendril::version_string, chain.size(), static_cast<double>(chain.reach()),
                static_cast<double>(head.x), static_cast<double>(head.y), static_cast<double>(head.z),
                static_cast<double>(tail.x), static_cast<double>(tail.y), static_cast<double>(tail.z));
}
