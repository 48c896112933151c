# A formula that no brew has run, only its steps by stand-ins, on Linux. Whoever publishes fills in the addresses and the hash.
class Tribox < Formula
  desc "Exact triangle-box overlap tests on many triangles at once"
  homepage "<address of this repository>"
  url "<address of this repository>/tribox-1.0.0.tar.xz"
  sha256 "<its line in SHA256SUMS>"
  license "MIT"

  depends_on "meson" => :build
  depends_on "ninja" => :build
  depends_on "libpng"
  uses_from_macos "zlib"

  def install
    system "meson", "setup", "build", "-Dtools=enabled", "-Dassimp=disabled", "-Dopenvdb=disabled",
           "-Dtests=disabled", "-Dbench=disabled", "-Dpython=disabled", *std_meson_args
    system "meson", "compile", "-C", "build", "--verbose"
    system "meson", "install", "-C", "build"
  end

  test do
    (testpath/"test.c").write <<~C
      #include <stdio.h>
      #include <tribox.h>
      int main(void) { return puts(tribox_version()) < 0; }
    C
    system ENV.cc, "test.c", "-I#{include}", "-L#{lib}", "-ltribox", "-o", "test"
    assert_equal version.to_s, shell_output("./test").strip
    assert_match version.to_s, shell_output("#{bin}/tribox --version")
  end
end
