#include "tests/app/support/apng.hpp"

#include <zlib.h>

#include <cstring>
#include <stdexcept>

namespace tendril::test {
namespace {

constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);

void require(bool holds, const std::string& what) {
    if (!holds) throw std::runtime_error("animated PNG: " + what);
}

std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t count = 4) {
    require(at + count <= bytes.size(), "a chunk is too short");
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + count; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
    return value;
}

std::string text_of(std::uint32_t value) {
    std::string text;
    for (const int shift : {24, 16, 8, 0}) text += static_cast<char>(value >> shift & 0xff);
    return text;
}

std::uint32_t check_sum(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

std::string chunk(const std::string& type, std::string_view data) {
    const std::string body = type + std::string(data);
    return text_of(static_cast<std::uint32_t>(data.size())) + body + text_of(check_sum(body));
}

class Reader {
  public:
    Apng read(std::string_view bytes) {
        require(bytes.starts_with(signature), "no PNG");
        bytes.remove_prefix(signature.size());
        while (!ended_) {
            const std::size_t size = number(bytes, 0);
            require(size + 12 <= bytes.size(), "it is cut off");
            require(number(bytes, size + 8) == check_sum(bytes.substr(4, size + 4)), "a check sum is wrong");
            take(std::string(bytes.substr(4, 4)), bytes.substr(8, size));
            bytes.remove_prefix(size + 12);
        }
        require(bytes.empty(), "something follows its end");
        require(apng_.frames.size() == announced_, "it has another number of frames than it says");
        return apng_;
    }

  private:
    void take(const std::string& type, std::string_view data) {
        require(head_.empty() == (type == "IHDR"), "IHDR must come first, and once");
        if (type == "IHDR") {
            require(data.size() == 13, "IHDR");
            head_ = data;
            apng_.size = {static_cast<int>(number(data, 0)), static_cast<int>(number(data, 4))};
        } else if (type == "acTL") {
            require(control_.empty(), "acTL comes late");
            announced_ = number(data, 0);
            apng_.plays = number(data, 4);
        } else if (type == "fcTL") {
            finish_frame();
            require(data.size() == 26, "fcTL");
            follow(data);
            control_ = data;
        } else if (type == "IDAT") {
            require(apng_.frames.empty() && !control_.empty(), "IDAT is no frame of its own");
            pixels_ += data;
        } else if (type == "fdAT") {
            require(!apng_.frames.empty() && !control_.empty(), "fdAT before the first frame");
            follow(data);
            pixels_ += data.substr(4);
        } else if (type == "IEND") {
            finish_frame();
            ended_ = true;
        }
    }
    void follow(std::string_view data) {
        require(number(data, 0) == sequence_++, "a sequence number is wrong");
    }
    /// Each frame's pixels are a PNG without header and trailer.
    void finish_frame() {
        if (control_.empty()) return;
        const glm::ivec2 size{static_cast<int>(number(control_, 4)), static_cast<int>(number(control_, 8))};
        const glm::ivec2 at{static_cast<int>(number(control_, 12)), static_cast<int>(number(control_, 16))};
        require(size.x > 0 && size.y > 0 && at.x >= 0 && at.y >= 0 && at.x <= apng_.size.x - size.x &&
                    at.y <= apng_.size.y - size.y,
                "a frame lies outside of the picture");
        require(number(control_, 24, 1) == 0 && number(control_, 25, 1) == 0,
                "a frame is disposed of or blended");
        require(!apng_.frames.empty() || size == apng_.size, "the first frame is not the whole picture");
        const std::string head = control_.substr(4, 8) + head_.substr(8);
        const app::Image part = app::decode_png(std::string(signature) + chunk("IHDR", head) +
                                                chunk("IDAT", pixels_) + chunk("IEND", {}));
        ApngFrame frame{.image = apng_.frames.empty() ? part : apng_.frames.back().image,
                        .numerator = number(control_, 20, 2),
                        .denominator = number(control_, 22, 2),
                        .changed = size};
        for (int y = 0; y < size.y; ++y) {
            const auto pixel = [](int x, int row, int width) {
                return 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x));
            };
            std::memcpy(&frame.image.rgba[pixel(at.x, at.y + y, apng_.size.x)],
                        &part.rgba[pixel(0, y, size.x)], 4 * static_cast<std::size_t>(size.x));
        }
        apng_.frames.push_back(std::move(frame));
        control_.clear();
        pixels_.clear();
    }

    Apng apng_;
    std::string head_, control_, pixels_;
    std::size_t announced_ = 0;
    std::uint32_t sequence_ = 0;
    bool ended_ = false;
};

}  // namespace

Apng read_apng(std::string_view bytes) {
    return Reader().read(bytes);
}

}  // namespace tendril::test
