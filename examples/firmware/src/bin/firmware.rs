//! The program for the board: renders the picture onto the display, says its digest and how much stack
//! it took to the debugger, and sleeps.
#![no_std]
#![no_main]

use core::convert::Infallible;
use core::ptr;

use cortex_m_rt::entry;
use cortex_m_semihosting::hio;
use embedded_graphics_core::Pixel;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::{Gray4, GrayColor};
use embedded_graphics_core::prelude::DrawTarget;
use embedded_graphics_core::primitives::Rectangle;
use nostray_firmware::{HEIGHT, WIDTH, show};

#[entry]
fn main() -> ! {
    let stack = Stack::paint();
    let mut display = Oled::new();
    match show(&mut display) {
        Ok(digest) => {
            say(b"sha256 ");
            for byte in digest {
                say(&[hex(byte >> 4), hex(byte & 15)]);
            }
            say(b"\nstack ");
            say_number(stack.used());
            say(b"\n");
        }
        Err(_) => say(b"no picture\n"),
    }
    loop {
        cortex_m::asm::wfi();
    }
}

/// Says something to the debugger, if there is one.
fn say(text: &[u8]) {
    if let Ok(mut out) = hio::hstdout() {
        // Without a debugger there is nobody to tell.
        let _ = out.write_all(text);
    }
}

fn say_number(number: u32) {
    let mut power = 1_000_000_000;
    while power > 1 && number < power {
        power /= 10;
    }
    while power > 0 {
        say(&[hex((number / power % 10) as u8)]);
        power /= 10;
    }
}

const fn hex(value: u8) -> u8 {
    if value < 10 { b'0' + value } else { b'a' - 10 + value }
}

unsafe extern "C" {
    /// The end of the variables.
    static mut _stack_low: u32;
    /// Where the stack begins.
    static _stack_start: u32;
}

/// The memory below the frames that are there, painted to see later how much of it was used.
struct Stack;

impl Stack {
    const PAINT: u32 = 0x5afe_c01a;
    /// How far below its own frame the painter keeps away.
    const MARGIN: usize = 256;

    #[inline(never)]
    fn paint() -> Self {
        let here = 0_u32;
        let (mut at, end) = (&raw mut _stack_low, &raw const here as usize - Self::MARGIN);
        while (at as usize) < end {
            // SAFETY: above every variable, below every frame.
            unsafe {
                ptr::write_volatile(at, Self::PAINT);
                at = at.add(1);
            }
        }
        Self
    }

    /// How many bytes have been used.
    fn used(&self) -> u32 {
        let (mut at, top) = (&raw const _stack_low, &raw const _stack_start);
        // SAFETY: reads what lies between the variables and the beginning of the stack.
        while at < top && unsafe { ptr::read_volatile(at) } == Self::PAINT {
            at = at.wrapping_add(1);
        }
        (top as usize - at as usize) as u32
    }
}

/// The display of the board, at its synchronous serial interface: 16 levels of grey, two pixels a
/// byte, the left one first.
struct Oled;

impl Oled {
    const CLOCK_SERIAL: *mut u32 = 0x400f_e104 as *mut u32;
    const CLOCK_PORTS: *mut u32 = 0x400f_e108 as *mut u32;
    /// Pins 2, 3 and 5 of port A are the serial interface.
    const A_FUNCTION: *mut u32 = 0x4000_4420 as *mut u32;
    const A_ENABLE: *mut u32 = 0x4000_451c as *mut u32;
    /// Pin 7 of port C tells pictures from commands.
    const C_DATA: *mut u32 = 0x4000_6200 as *mut u32;
    const C_DIRECTION: *mut u32 = 0x4000_6400 as *mut u32;
    const C_ENABLE: *mut u32 = 0x4000_651c as *mut u32;
    const SERIAL_CONTROL0: *mut u32 = 0x4000_8000 as *mut u32;
    const SERIAL_CONTROL1: *mut u32 = 0x4000_8004 as *mut u32;
    const SERIAL_DATA: *mut u32 = 0x4000_8008 as *mut u32;
    const SERIAL_STATUS: *mut u32 = 0x4000_800c as *mut u32;
    const SERIAL_PRESCALE: *mut u32 = 0x4000_8010 as *mut u32;

    fn new() -> Self {
        set_bits(Self::CLOCK_SERIAL, 1 << 4);
        set_bits(Self::CLOCK_PORTS, 1 << 0 | 1 << 2);
        set_bits(Self::A_FUNCTION, 0x2c);
        set_bits(Self::A_ENABLE, 0x2c);
        set_bits(Self::C_DIRECTION, 1 << 7);
        set_bits(Self::C_ENABLE, 1 << 7);
        // Eight bits a word, a slow clock, on.
        write(Self::SERIAL_PRESCALE, 4);
        write(Self::SERIAL_CONTROL0, 7);
        write(Self::SERIAL_CONTROL1, 1 << 1);
        let mut display = Self;
        // Left to right and top to bottom; light on.
        display.command(&[0xa0, 0x00, 0xaf]);
        display
    }

    fn command(&mut self, bytes: &[u8]) {
        self.send(false, bytes.iter().copied());
    }

    fn send(&mut self, picture: bool, bytes: impl Iterator<Item = u8>) {
        const RECEIVED: u32 = 1 << 2;
        write(Self::C_DATA, if picture { 1 << 7 } else { 0 });
        for byte in bytes {
            write(Self::SERIAL_DATA, u32::from(byte));
            // For each bit that leaves one comes in. When all have come, all have left.
            while read(Self::SERIAL_STATUS) & RECEIVED == 0 {}
            read(Self::SERIAL_DATA);
        }
    }
}

impl OriginDimensions for Oled {
    fn size(&self) -> Size {
        Size::new(WIDTH as u32, HEIGHT as u32)
    }
}

impl DrawTarget for Oled {
    type Color = Gray4;
    type Error = Infallible;

    /// One pixel is half a byte, and the display cannot be read: a row is what this one is for.
    fn draw_iter<I: IntoIterator<Item = Pixel<Gray4>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(at, color) in pixels {
            self.fill_contiguous(&Rectangle::new(at, Size::new(2, 1)), [color, color])?;
        }
        Ok(())
    }

    /// Areas begin at an even column and are an even number of pixels wide.
    fn fill_contiguous<I: IntoIterator<Item = Gray4>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        let [left, top] = [area.top_left.x, area.top_left.y].map(|at| at as u8);
        let [width, height] = [area.size.width, area.size.height].map(|size| size as u8);
        self.command(&[0x15, left / 2, (left + width) / 2 - 1]);
        self.command(&[0x75, top, top + height - 1]);
        let mut colors = colors.into_iter();
        let pairs = core::iter::from_fn(|| Some([colors.next()?, colors.next()?]));
        self.send(true, pairs.map(|[left, right]| left.luma() << 4 | right.luma()));
        Ok(())
    }
}

fn write(register: *mut u32, value: u32) {
    // SAFETY: only with the addresses of registers above.
    unsafe { ptr::write_volatile(register, value) }
}

fn read(register: *mut u32) -> u32 {
    // SAFETY: only with the addresses of registers above.
    unsafe { ptr::read_volatile(register) }
}

fn set_bits(register: *mut u32, bits: u32) {
    write(register, read(register) | bits);
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    #[cfg(not(debug_assertions))]
    {
        unsafe extern "C" {
            fn a_panic_can_be_reached() -> !;
        }
        // SAFETY: no such function exists, so this program exists only without the call.
        unsafe { a_panic_can_be_reached() }
    }
    #[cfg(debug_assertions)]
    loop {
        cortex_m::asm::bkpt();
    }
}
