#pragma once

#include <hpdf.h>
#include <memory>
#include <string>
#include <type_traits>

#include "formwork/panels/pattern.hpp"

namespace formwork {

struct Colour {
    float r, g, b;
};

/// A PDF in memory. libharu calls back from C: the first failure is kept and thrown by `finish`.
class PdfDocument {
public:
    PdfDocument(const std::string& title);
    /// The bytes of the file.  @throws arcsim::NumericalError when libharu failed
    std::string finish();

private:
    friend class PdfPage;
    struct Failure {
        HPDF_STATUS error = 0, detail = 0;
    };
    static void on_error(HPDF_STATUS error, HPDF_STATUS detail, void* failure);

    Failure failure_;
    std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, decltype(&HPDF_Free)> doc_;
    HPDF_Font font_;
};

/// One page in millimetres, y up from its lower left corner.
class PdfPage {
public:
    PdfPage(PdfDocument& document, const Vector2d& size);

    void colour(const Colour& c);
    void width(double mm);
    void dashed(bool on);
    void line(const Line& line, bool closed);
    void box(const Vector2d& low, const Vector2d& size);
    void clip_to(const Vector2d& low, const Vector2d& size);
    void end_clip();
    void text(const Vector2d& at, double capital_mm, double angle, const std::string& string, bool centred);

private:
    HPDF_Page page_;
    HPDF_Font font_;
};

}  // namespace formwork
