/* Prints the digests that the Rust library computes: in fixed point alone, or in floats too; or of the lean picture. */
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>

/* The toolchain's 128-bit division comes with tables for unwinding, which never happens. */
void rust_eh_personality(void) {
}

int main(void) {
#ifdef LEAN
    uint64_t nostray_digest_lean(void);
    printf("%016" PRIx64, nostray_digest_lean());
#else
    uint64_t nostray_digest_q16(void);
    uint64_t nostray_digest_q32(void);
    printf("%016" PRIx64 " %016" PRIx64, nostray_digest_q16(), nostray_digest_q32());
#endif
#ifdef FLOAT
    uint64_t nostray_digest_f32(void);
    uint64_t nostray_digest_f64(void);
    printf(" %016" PRIx64 " %016" PRIx64, nostray_digest_f32(), nostray_digest_f64());
#endif
    putchar('\n');
    return 0;
}
