//! JSON Schemas of types with hand-written readers.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use std::borrow::Cow;
use std::marker::PhantomData;

/// Gives a type the schema of another.
macro_rules! shaped {
    (@ $($parameter:ident)?; $type:ty as $shape:ty) => {
        impl<$($parameter: ::schemars::JsonSchema)?> ::schemars::JsonSchema for $type {
            fn schema_name() -> ::std::borrow::Cow<'static, str> {
                <$shape as ::schemars::JsonSchema>::schema_name()
            }

            fn schema_id() -> ::std::borrow::Cow<'static, str> {
                <$shape as ::schemars::JsonSchema>::schema_id()
            }

            fn json_schema(generator: &mut ::schemars::SchemaGenerator) -> ::schemars::Schema {
                <$shape as ::schemars::JsonSchema>::json_schema(generator)
            }

            fn inline_schema() -> bool {
                <$shape as ::schemars::JsonSchema>::inline_schema()
            }
        }
    };
    ($type:ty as $shape:ty) => {
        shaped!(@; $type as $shape);
    };
}
pub(crate) use shaped;

/// A value in one of two forms.
pub(crate) struct Either<A, B>(PhantomData<(A, B)>);

impl<A: JsonSchema, B: JsonSchema> JsonSchema for Either<A, B> {
    fn schema_name() -> Cow<'static, str> {
        format!("{} or {}", A::schema_name(), B::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let forms = [generator.subschema_for::<A>(), generator.subschema_for::<B>()];
        schemars::json_schema!({ "anyOf": forms })
    }

    fn inline_schema() -> bool {
        true
    }
}
