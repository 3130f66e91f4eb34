/* Prints the digests that the Rust library computes. */
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>

uint64_t nostray_digest_f32(void);
uint64_t nostray_digest_f64(void);

int main(void) {
    printf("%016" PRIx64 " %016" PRIx64 "\n", nostray_digest_f32(), nostray_digest_f64());
    return 0;
}
