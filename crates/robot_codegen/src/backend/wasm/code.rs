//! The instructions of a function; the same methods write them for single numbers and for lanes.

use wasm_encoder::{BlockType, InstructionSink, MemArg, ValType};

use crate::backend::common::Scalar;

/// The kind of values with which a function computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Kind {
    /// The number type.
    pub(super) scalar: Scalar,
    /// Whether a value consists of several numbers in lanes, in 128 bits.
    pub(super) lanes: bool,
}

impl Kind {
    /// The WebAssembly type of a value.
    pub(super) fn value(self) -> ValType {
        match (self.lanes, self.scalar) {
            (true, _) => ValType::V128,
            (false, Scalar::F64) => ValType::F64,
            (false, Scalar::F32) => ValType::F32,
        }
    }

    /// The WebAssembly type of the bits of a value.
    pub(super) fn bits(self) -> ValType {
        match (self.lanes, self.scalar) {
            (true, _) => ValType::V128,
            (false, Scalar::F64) => ValType::I64,
            (false, Scalar::F32) => ValType::I32,
        }
    }

    /// The size of a number, in bytes.
    pub(super) fn size(self) -> u32 {
        if self.scalar == Scalar::F64 { 8 } else { 4 }
    }

    /// The size of a value, in bytes.
    pub(super) fn bytes(self) -> u32 {
        if self.lanes { 16 } else { self.size() }
    }

    /// The size of a number, in bits.
    pub(super) fn width(self) -> u32 {
        8 * self.size()
    }

    /// The sign bit.
    pub(super) fn sign(self) -> u64 {
        1 << (self.width() - 1)
    }

    /// The bits of a number of the type.
    pub(super) fn pattern(self, value: f64) -> u64 {
        match self.scalar {
            Scalar::F64 => value.to_bits(),
            Scalar::F32 => u64::from((value as f32).to_bits()),
        }
    }

    /// The largest finite number.
    pub(super) fn largest(self) -> f64 {
        if self.scalar == Scalar::F64 { f64::MAX } else { f64::from(f32::MAX) }
    }
}

/// A local of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Local(pub(super) u32);

/// The instructions of a function under construction.
pub(super) struct Code {
    pub(super) kind: Kind,
    pub(super) parameters: Vec<ValType>,
    pub(super) results: Vec<ValType>,
    pub(super) locals: Vec<ValType>,
    pub(super) bytes: Vec<u8>,
}

/// Defines methods that write an instruction for the kind of the function. The instruction is given for 64-bit numbers,
/// for 32-bit numbers, and for lanes of both.
macro_rules! instructions {
    ($($(#[$doc:meta])* $name:ident = $f64:ident $f32:ident $f64x2:ident $f32x4:ident;)*) => {
        $(
            $(#[$doc])*
            pub(super) fn $name(&mut self) -> &mut Code {
                let Kind { scalar, lanes } = self.kind;
                let mut sink = self.sink();
                match (lanes, scalar) {
                    (false, Scalar::F64) => sink.$f64(),
                    (false, Scalar::F32) => sink.$f32(),
                    (true, Scalar::F64) => sink.$f64x2(),
                    (true, Scalar::F32) => sink.$f32x4(),
                };
                self
            }
        )*
    };
}

impl Code {
    pub(super) fn new(kind: Kind, parameters: Vec<ValType>, results: Vec<ValType>) -> Code {
        Code { kind, parameters, results, locals: vec![], bytes: vec![] }
    }

    pub(super) fn sink(&mut self) -> InstructionSink<'_> {
        InstructionSink::new(&mut self.bytes)
    }

    /// Adds a local of a type.
    pub(super) fn local(&mut self, ty: ValType) -> Local {
        self.locals.push(ty);
        Local((self.parameters.len() + self.locals.len() - 1) as u32)
    }

    /// Adds locals for values.
    pub(super) fn values<const N: usize>(&mut self) -> [Local; N] {
        let ty = self.kind.value();
        [(); N].map(|()| self.local(ty))
    }

    /// Adds locals for the bits of values.
    pub(super) fn patterns<const N: usize>(&mut self) -> [Local; N] {
        let ty = self.kind.bits();
        [(); N].map(|()| self.local(ty))
    }

    pub(super) fn get(&mut self, local: Local) -> &mut Code {
        self.sink().local_get(local.0);
        self
    }

    pub(super) fn set(&mut self, local: Local) -> &mut Code {
        self.sink().local_set(local.0);
        self
    }

    pub(super) fn call(&mut self, function: u32) -> &mut Code {
        self.sink().call(function);
        self
    }

    pub(super) fn drop(&mut self) -> &mut Code {
        self.sink().drop();
        self
    }

    /// Writes an address or a count.
    pub(super) fn whole(&mut self, value: u32) -> &mut Code {
        self.sink().i32_const(value.cast_signed());
        self
    }

    instructions! {
        add = f64_add f32_add f64x2_add f32x4_add;
        sub = f64_sub f32_sub f64x2_sub f32x4_sub;
        mul = f64_mul f32_mul f64x2_mul f32x4_mul;
        div = f64_div f32_div f64x2_div f32x4_div;
        neg = f64_neg f32_neg f64x2_neg f32x4_neg;
        abs = f64_abs f32_abs f64x2_abs f32x4_abs;
        sqrt = f64_sqrt f32_sqrt f64x2_sqrt f32x4_sqrt;
        /// Bitwise AND.
        and = i64_and i32_and v128_and v128_and;
        /// Bitwise OR.
        or = i64_or i32_or v128_or v128_or;
        /// Bitwise exclusive OR.
        xor = i64_xor i32_xor v128_xor v128_xor;
        /// The sum of bits as integers.
        whole_add = i64_add i32_add i64x2_add i32x4_add;
        /// The difference of bits as integers.
        whole_sub = i64_sub i32_sub i64x2_sub i32x4_sub;
    }

    /// Writes a number, in all lanes.
    pub(super) fn number(&mut self, value: f64) -> &mut Code {
        let kind = self.kind;
        match (kind.lanes, kind.scalar) {
            (false, Scalar::F64) => self.sink().f64_const(value.into()),
            (false, Scalar::F32) => self.sink().f32_const((value as f32).into()),
            (true, _) => return self.pattern(kind.pattern(value)),
        };
        self
    }

    /// Writes a pattern of bits, in all lanes.
    pub(super) fn pattern(&mut self, bits: u64) -> &mut Code {
        let Kind { scalar, lanes } = self.kind;
        let wide = match scalar {
            Scalar::F64 => bits,
            Scalar::F32 => bits << 32 | bits,
        };
        let all = (u128::from(wide) << 64 | u128::from(wide)).cast_signed();
        let mut sink = self.sink();
        match (lanes, scalar) {
            (false, Scalar::F64) => sink.i64_const(bits.cast_signed()),
            (false, Scalar::F32) => sink.i32_const((bits as u32).cast_signed()),
            (true, _) => sink.v128_const(all),
        };
        self
    }

    /// Reinterprets a value as its bits.
    pub(super) fn bits_of(&mut self) -> &mut Code {
        match (self.kind.lanes, self.kind.scalar) {
            (true, _) => return self,
            (false, Scalar::F64) => self.sink().i64_reinterpret_f64(),
            (false, Scalar::F32) => self.sink().i32_reinterpret_f32(),
        };
        self
    }

    /// Reinterprets bits as a value.
    pub(super) fn value_of(&mut self) -> &mut Code {
        match (self.kind.lanes, self.kind.scalar) {
            (true, _) => return self,
            (false, Scalar::F64) => self.sink().f64_reinterpret_i64(),
            (false, Scalar::F32) => self.sink().f32_reinterpret_i32(),
        };
        self
    }

    /// Shifts bits to the left by a number of places.
    pub(super) fn left(&mut self, places: u32) -> &mut Code {
        let Kind { scalar, lanes } = self.kind;
        if lanes || scalar == Scalar::F32 {
            self.whole(places);
        } else {
            self.pattern(u64::from(places));
        }
        match (lanes, scalar) {
            (false, Scalar::F64) => self.sink().i64_shl(),
            (false, Scalar::F32) => self.sink().i32_shl(),
            (true, Scalar::F64) => self.sink().i64x2_shl(),
            (true, Scalar::F32) => self.sink().i32x4_shl(),
        };
        self
    }

    /// Sets all bits if the highest is set, otherwise none.
    pub(super) fn spread_sign(&mut self) -> &mut Code {
        let Kind { scalar, lanes } = self.kind;
        let places = self.kind.width() - 1;
        if lanes || scalar == Scalar::F32 {
            self.whole(places);
        } else {
            self.pattern(u64::from(places));
        }
        match (lanes, scalar) {
            (false, Scalar::F64) => self.sink().i64_shr_s(),
            (false, Scalar::F32) => self.sink().i32_shr_s(),
            (true, Scalar::F64) => self.sink().i64x2_shr_s(),
            (true, Scalar::F32) => self.sink().i32x4_shr_s(),
        };
        self
    }

    /// Sets all bits if the first value is larger than the second, otherwise none.
    pub(super) fn is_above(&mut self) -> &mut Code {
        match (self.kind.lanes, self.kind.scalar) {
            (false, Scalar::F64) => self.sink().f64_gt(),
            (false, Scalar::F32) => self.sink().f32_gt(),
            (true, Scalar::F64) => self.sink().f64x2_gt(),
            (true, Scalar::F32) => self.sink().f32x4_gt(),
        };
        self.mask()
    }

    /// Sets all bits if the values differ or one is NaN, otherwise none.
    pub(super) fn differs(&mut self) -> &mut Code {
        match (self.kind.lanes, self.kind.scalar) {
            (false, Scalar::F64) => self.sink().f64_ne(),
            (false, Scalar::F32) => self.sink().f32_ne(),
            (true, Scalar::F64) => self.sink().f64x2_ne(),
            (true, Scalar::F32) => self.sink().f32x4_ne(),
        };
        self.mask()
    }

    /// Turns the result of a comparison of numbers, 1 or 0, into all bits or none; comparisons of lanes are masks
    /// already.
    fn mask(&mut self) -> &mut Code {
        match (self.kind.lanes, self.kind.scalar) {
            (true, _) => self,
            (false, Scalar::F64) => {
                self.sink().i64_extend_i32_u().i64_const(-1).i64_mul();
                self
            }
            (false, Scalar::F32) => {
                self.sink().i32_const(-1).i32_mul();
                self
            }
        }
    }

    fn place(&self, offset: u32) -> MemArg {
        let align = if self.kind.scalar == Scalar::F64 { 3 } else { 2 };
        MemArg { offset: u64::from(offset), align, target: Default::default(), ordering: None }
    }

    /// Loads the value at an address.
    pub(super) fn load(&mut self, offset: u32) -> &mut Code {
        let place = self.place(offset);
        match (self.kind.lanes, self.kind.scalar) {
            (false, Scalar::F64) => self.sink().f64_load(place),
            (false, Scalar::F32) => self.sink().f32_load(place),
            (true, _) => self.sink().v128_load(place),
        };
        self
    }

    /// Loads the number at an address into all lanes.
    pub(super) fn load_number(&mut self, offset: u32) -> &mut Code {
        let place = self.place(offset);
        match (self.kind.lanes, self.kind.scalar) {
            (false, _) => return self.load(offset),
            (true, Scalar::F64) => self.sink().v128_load64_splat(place),
            (true, Scalar::F32) => self.sink().v128_load32_splat(place),
        };
        self
    }

    /// Stores a value at an address, which is below it on the stack.
    pub(super) fn store(&mut self, offset: u32) -> &mut Code {
        let place = self.place(offset);
        match (self.kind.lanes, self.kind.scalar) {
            (false, Scalar::F64) => self.sink().f64_store(place),
            (false, Scalar::F32) => self.sink().f32_store(place),
            (true, _) => self.sink().v128_store(place),
        };
        self
    }

    /// Writes a loop that repeats the instructions of `body` while the count in `local` is at least `least`.
    pub(super) fn repeat(&mut self, local: Local, least: u32, body: impl FnOnce(&mut Code)) {
        self.sink().block(BlockType::Empty).loop_(BlockType::Empty);
        self.get(local).whole(least);
        self.sink().i32_lt_u().br_if(1);
        body(self);
        self.sink().br(0).end().end();
    }
}
