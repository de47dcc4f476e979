// A fixed piece of work: .ci/run times how long this machine takes to compile it, and tells its own time in units of
// that too. Never change it, or times of before and after cannot be compared.
#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

template <int N>
struct Row {
    using Value = std::variant<int, double, std::string, std::vector<int>>;
    std::map<std::string, Value> values;
    std::unordered_map<std::string, std::function<Value(const Value&)>> changes;

    std::string joined(const std::string& pattern) const {
        std::string all;
        const std::regex wanted(pattern + std::to_string(N));
        for (const auto& [name, value] : values)
            if (std::regex_search(name, wanted))
                all += std::visit(
                    [](const auto& each) {
                        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(each)>>) return std::to_string(each + N);
                        else if constexpr (std::is_same_v<std::decay_t<decltype(each)>, std::string>) return each;
                        else return std::to_string(each.size());
                    },
                    value);
        return all;
    }
    void change() {
        for (auto& [name, value] : values)
            if (const auto found = changes.find(name); found != changes.end()) value = found->second(value);
    }
};

template <int N>
std::string all_rows(const std::string& pattern) {
    Row<N> row;
    row.values["a" + std::to_string(N)] = N;
    row.changes["a"] = [](const auto& value) { return value; };
    row.change();
    if constexpr (N > 0) return row.joined(pattern) + all_rows<N - 1>(pattern);
    else return row.joined(pattern);
}

int main(int count, char** arguments) {
    std::vector<std::string> words(arguments, arguments + count);
    std::sort(words.begin(), words.end());
    for (const std::string& word : words) std::cout << all_rows<12>(word) << '\n';
}
